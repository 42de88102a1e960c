#pragma once

#include <vector>

#include "trajet/collide/sustain/contact_law.hpp"
#include "trajet/law/program_number.hpp"

namespace trajet::detail {

/// Builds on a group's law how one of its bodies moves at its contacts, as computations of a program.
class ContactBuilder {
 public:
  /// `builder` has opened the law. All outlive the object.
  ContactBuilder(ProgramBuilder& builder, const Program& law, const SustainedBody& body,
                 const std::vector<SustainedContact>& contacts);

  /// Whether all derivatives that are needed are among our operations.
  bool has_derivatives() const { return has_derivatives_; }
  const BodyTerms<ProgramNumber>& terms() const { return terms_; }
  /// The rates of the group's state with forces at the body's contacts: nodes.
  std::vector<int> rates_with(const std::vector<ContactForce<ProgramNumber>>& forces);
  /// How far the body is past each end of the contact's patch.
  std::vector<ProgramNumber> past_edges(std::size_t contact);
  /// How high a corner of the body is above the contact's patch, which is flat.
  ProgramNumber height(std::size_t contact, const SupportCorner& corner);

 private:
  using Vector = Vector3T<ProgramNumber>;
  using Matrix = Eigen::Matrix<ProgramNumber, 3, 3>;

  /// Where the obstacle of a contact is: its pivot, and how it has turned since the start.
  struct Frame {
    Vector place;
    Matrix R;
  };

  Vector inputs(int first);
  ProgramNumber rate_of(const ProgramNumber& number);
  Vector rate_of(const Vector& vector);
  Frame frame_of(const SustainedContact& contact);
  /// The body's position as the obstacle saw it at the start.
  Vector seen_by(const SustainedContact& contact, const Frame& frame, const Vector& place) const;
  /// From the centre of mass to where a corner touches a surface of that normal.
  Vector arm_of(const SupportCorner& corner, const Vector& normal) const;
  void add_contact(const SustainedContact& contact);

  ProgramBuilder& builder_;
  const SustainedBody& body_;
  const std::vector<SustainedContact>& contacts_;
  bool has_derivatives_ = true;
  std::vector<int> of_inputs_;  // 1 and the law's rates
  Vector position_, velocity_;  // velocity: the rate of the position
  Matrix R_WB_;
  Vector w_;  // world frame
  BodyTerms<ProgramNumber> terms_;
};

}  // namespace trajet::detail
