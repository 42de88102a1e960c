#pragma once

#include "separation.hpp"

namespace trajet::detail {

/// An axis and what it shows at one time.
struct AxisCandidate {
  WitnessAxis axis{};
  double separation = -std::numeric_limits<double>::infinity();  ///< m
  double resolution = 0.0;  ///< m: below it the separation cannot be told from zero along this axis
  double apart = 0.0;       ///< m: the distance by two closest points; no axis can show more

  bool is_clear() const { return separation > resolution; }
};

/// Chooses the axis to go on with at one time: any will do for the proof, a good one lasts longer.
class AxisChoice {
 public:
  /// `size`: of the solids together, m.
  AxisChoice(const ConvexCore& A, const ConvexCore& B, double size) : A_(A), B_(B), size_(size) {}

  /// The axis with the best separation of those that the closest features offer. Where none is clear, the solids touch
  /// or overlap, and it is the best of all that are near the place of contact, or of all there are.
  ///
  /// `tolerance`: the resolution along an axis of length 1, m. `place`: where, in A, the solids are known to be within
  /// the tolerance of a contact; the features around it are looked at too.
  AxisCandidate choose(const RelativePose& pose, double tolerance, const Vector3* place = nullptr);

  /// An axis measured by all of both solids.
  AxisCandidate measure(const RelativePose& pose, const WitnessAxis& axis, double tolerance) const;

 private:
  void offer(const WitnessAxis& axis);
  void offer_face_of_a(int face);
  void offer_face_of_b(int face);
  void offer_edges(int edge_a, int edge_b);
  void offer_fixed(const Vector3& direction);
  void offer_rounded(const ClosestFeatures& closest, const std::vector<int>& edges_a, const std::vector<int>& edges_b);
  void offer_near(const Vector3& place);
  void offer_all();

  const ConvexCore& A_;
  const ConvexCore& B_;
  double size_;
  Vector3 guess_ = Vector3::Zero();
  // of one choice
  RelativePose pose_{};
  double tolerance_ = 0.0;
  AxisCandidate best_{};
};

}  // namespace trajet::detail
