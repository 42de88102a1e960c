#pragma once

#include "trajet/math/vector.hpp"

namespace trajet {

/// What a witness axis is fixed to. A and B are the two solids of a pair.
enum class AxisKind {
  in_a,         ///< fixed in A: the normal of one of its faces, or any direction
  in_b,         ///< fixed in B
  edges,        ///< orthogonal to an edge, or another line, of A and one of B
  edge_vertex,  ///< from an edge of A to a vertex of B, orthogonal to the edge
  vertex_edge,  ///< from a vertex of A to an edge of B, orthogonal to the edge
  vertices,     ///< from a vertex of A to one of B
  balls,        ///< from the middle of A to that of B: the balls around them
};

/// A direction that turns with two convex solids. As long as everything of B lies farther along it than everything of A
/// there is no contact, whatever the direction.
struct WitnessAxis {
  AxisKind kind = AxisKind::in_a;
  int a = -1;                           ///< face, edge or vertex of A's core; -1: none, or a line that is no edge
  int b = -1;                           ///< ... of B's
  double sign = 1.0;                    ///< edges: of the product of A's edge and B's
  /// in_a and in_b: unit, from A to B, in the frame of that solid. edges without numbers: that of A's line, in A.
  Vector3 direction = Vector3::Zero();
  Vector3 line_b = Vector3::Zero();  ///< edges without numbers: that of B's line, in B, unit

  bool operator==(const WitnessAxis&) const = default;
};

/// A link of a chain of witnesses: along the axis the solids are apart between the two times. A chain without holes
/// proves that there is no contact.
struct WitnessLink {
  WitnessAxis axis{};
  double from = 0.0;  ///< s
  double to = 0.0;
};

}  // namespace trajet
