#include "trajet/geom/convex_pieces.hpp"

#include <utility>
#include <variant>

#include "trajet/geom/compound.hpp"

namespace trajet {

namespace {

/// The core where it stands in another frame.
ConvexCore placed(ConvexCore core, const Vector3& p, const Matrix3& R) {
  for (Vector3& vertex : core.vertices) vertex = p + R * vertex;
  for (Matrix3& spread : core.spreads) spread = R * spread;
  for (CoreFace& face : core.faces) {
    face.normal = R * face.normal;
    face.offset += face.normal.dot(p);
  }
  for (CoreEdge& edge : core.edges) {
    edge.direction = R * edge.direction;
    for (Vector3& inward : edge.inward) inward = R * inward;
  }
  core.reach += p.norm();
  return core;
}

}  // namespace

ConvexPieces convex_pieces(const Solid& solid) {
  if (const auto* compound = std::get_if<Compound>(&solid)) {
    ConvexPieces pieces;
    for (const CompoundPart& part : compound->parts->parts)
      for (ConvexCore& piece : convex_pieces(part.solid))
        pieces.push_back(placed(std::move(piece), part.p_BP, part.R_BP));
    return pieces;
  }
  const auto* mesh = std::get_if<Mesh>(&solid);
  if (mesh == nullptr) return {convex_core(solid)};
  const TriangleMesh& surface = mesh->polyhedron->surface;
  ConvexPieces pieces;
  pieces.reserve(surface.triangles.size());
  for (const auto& corners : surface.triangles) {
    std::vector<Vector3> triangle;
    for (const int corner : corners) triangle.push_back(surface.vertices[static_cast<std::size_t>(corner)]);
    pieces.push_back(polygon_core(triangle));
  }
  return pieces;
}

}  // namespace trajet
