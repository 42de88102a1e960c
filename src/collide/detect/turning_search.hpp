#pragma once

#include <optional>
#include <vector>

#include "axis_choice.hpp"
#include "separation.hpp"
#include "touch.hpp"
#include "trajet/collide/detect/turning_contact.hpp"

namespace trajet::detail {

/// The search of `first_contact` for a pair of which A may be a half space and B is none. Normals point from A to B.
class TurningSearch {
 public:
  TurningSearch(const ConvexCore& A, const FramePath& a, const ConvexCore& B, const FramePath& b, double from,
                double to, const TurningMemory& memory, std::vector<WitnessLink>* chain);

  TurningContact run();

 private:
  bool is_before(double s, double t) const { return from_ <= to_ ? s < t : s > t; }
  bool starts_in_contact() const { return memory_.contact_time == from_; }
  RelativePose pose_at(double t) const { return relative_pose(a_.pose(t), b_.pose(t)); }

  /// Goes to where the balls around the solids meet; false if they do not.
  bool approach();
  RelativeMotion next_window() const;
  void search_window();
  /// An axis for the begin of a window; false if that ends the search.
  bool begin_axis(const RelativeMotion& window, double tolerance);
  /// What follows at a zero of the separation; true if the window goes on.
  bool follow(const RelativeMotion& window, double tolerance, const SeparationZero& zero, double& u);
  bool needs_shorter_window(const RelativeMotion& window, const Separation& along,
                            const std::optional<SeparationZero>& zero, double u);

  /// Whether direction and place of a contact follow from curved surfaces, to be found by steps.
  bool is_curved() const { return !A_.is_half_space && (A_.is_spread() || B_.is_spread()); }
  Vector3 direction_now(const RelativePose& pose) const;
  /// Of the axis and of others near a direction takes that along which they are apart for longest from u on: of those
  /// that are fixed in one of the solids, and of those that are orthogonal to lines of both.
  void take_longest(const RelativeMotion& window, double u, const RelativePose& pose, const Vector3& near,
                    double begin_tolerance);

  void link(double from, double to);
  void finish(ContactStatus status, double time);
  AxisCandidate choose(const RelativeMotion& window, double u, const RelativePose& pose, double tolerance,
                       const Vector3* place);
  /// The best axis; where none is clear, what is near a direction, or zero, is looked at too.
  AxisCandidate best_axis(const RelativePose& pose, double tolerance, const Vector3* place, const Vector3& near);
  void report(const RelativeMotion& window, double tolerance, const SeparationZero& zero, double time, double apart,
              bool is_known);
  /// Whether solids that touch within the tolerance at a time, at a place in A, are apart again behind it, before they
  /// overlap. Looks from `first` (s) behind it.
  bool parts_behind(const RelativeMotion& window, double time, double tolerance, const Vector3& place,
                    const Vector3& normal, double first);

  const ConvexCore& A_;
  const ConvexCore& B_;
  const FramePath& a_;
  const FramePath& b_;
  double from_;
  double to_;
  const TurningMemory& memory_;
  std::vector<WitnessLink>* chain_;
  double size_;  // of both, m
  AxisChoice choice_;

  double time_;     // up to which there is no contact
  double longest_;  // window, s
  std::optional<WitnessAxis> axis_{};
  bool is_touching_ = false;     // the axis is that of a contact that is left
  bool stays_touching_ = false;  // ... and was not left yet at the end of the last window
  bool is_done_ = false;
  int links_ = 0;
  int stalls_ = 0;
  int zooms_ = 0;
  TurningContact contact_{};
};

}  // namespace trajet::detail
