#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "trajet/math/vector.hpp"

namespace trajet {

/// Makes one vertex of those that are in one place, exactly; 0 and -0 are one.
class VertexJoiner {
 public:
  /// The index of the vertex at p, m: of the first one that was there. Throws std::domain_error if it is not finite.
  int index(const Vector3& p);

  /// All, in the order in which they came.
  const std::vector<Vector3>& vertices() const { return vertices_; }
  std::vector<Vector3> take_vertices() { return std::move(vertices_); }

 private:
  void grow();
  std::size_t slot_of(const Vector3& p) const;

  std::vector<Vector3> vertices_;
  std::vector<int> table_;  // indices of vertices by the hash of their place, -1: free; at most half full
};

}  // namespace trajet
