#pragma once

#include <array>

#include "trajet/geom/convex_core.hpp"

namespace trajet {

/// B's frame in A's.
struct RelativePose {
  Vector3 p_AB = Vector3::Zero();  ///< m
  Matrix3 R_AB = Matrix3::Identity();
};

/// A few indices, each once.
struct FeatureVertices {
  std::array<int, 4> index{};
  int count = 0;

  void add(int i) {
    for (int k = 0; k < count; ++k)
      if (index[static_cast<std::size_t>(k)] == i) return;
    index[static_cast<std::size_t>(count++)] = i;
  }
  const int* begin() const { return index.data(); }
  const int* end() const { return index.data() + count; }
};

/// Where two bounded cores, roundings left out, come closest. In A's frame.
struct ClosestFeatures {
  double distance = 0.0;                ///< m; zero where they overlap
  Vector3 direction = Vector3::Zero();  ///< unit, from A to B; zero where they overlap
  Vector3 on_a = Vector3::Zero();       ///< the points that are closest
  Vector3 on_b = Vector3::Zero();
  FeatureVertices a;  ///< the vertices of the features in which they lie
  FeatureVertices b;
};

/// By the algorithm of Gilbert, Johnson and Keerthi [GilbertJohnsonKeerthi1988]. The distance of polytopes of some size
/// is right to a few roundings of it. Below 1e-8 of it the features are those of rounding.
/// `guess`: a direction from A to B to begin with, or zero.
ClosestFeatures closest_features(const ConvexCore& a, const ConvexCore& b, const RelativePose& pose,
                                 const Vector3& guess = Vector3::Zero());

}  // namespace trajet
