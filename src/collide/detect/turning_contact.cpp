#include "trajet/collide/detect/turning_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "turning_search.hpp"

namespace trajet {
namespace {

/// The same axis where A and B change places.
std::optional<WitnessAxis> exchanged(std::optional<WitnessAxis> axis) {
  if (!axis) return axis;
  std::swap(axis->a, axis->b);
  if (axis->kind == AxisKind::edges) {  // -(f x e) = e x f
    std::swap(axis->direction, axis->line_b);
    return axis;
  }
  switch (axis->kind) {
    case AxisKind::in_a:
      axis->kind = AxisKind::in_b;
      break;
    case AxisKind::in_b:
      axis->kind = AxisKind::in_a;
      break;
    case AxisKind::edge_vertex:
      axis->kind = AxisKind::vertex_edge;
      break;
    case AxisKind::vertex_edge:
      axis->kind = AxisKind::edge_vertex;
      break;
    case AxisKind::edges:
    case AxisKind::vertices:
    case AxisKind::balls:
      break;
  }
  axis->direction = -axis->direction;
  return axis;
}

}  // namespace

double TurningContact::time_error(double gap_error) const {
  if (!(gap_error > 0.0)) return 0.0;
  return std::min(gap_error / std::abs(gap_rate), std::sqrt(2.0 * gap_error / std::abs(gap_curvature)));
}

TurningContact first_contact(const ConvexCore& a, const FramePath& path_a, const ConvexCore& b, const FramePath& path_b,
                             double from, double to, const TurningMemory& memory, std::vector<WitnessLink>* chain) {
  assert(!(a.is_half_space && b.is_half_space));
  if (a.is_half_space) {
    TurningContact contact = detail::TurningSearch(a, path_a, b, path_b, from, to, memory, chain).run();
    contact.normal = -contact.normal;
    return contact;
  }
  // the normal of b towards a is that from b to a: b takes the first place
  TurningMemory turned = memory;
  turned.axis = exchanged(memory.axis);
  turned.direction = -memory.direction;
  const std::size_t known = chain == nullptr ? 0 : chain->size();
  TurningContact contact = detail::TurningSearch(b, path_b, a, path_a, from, to, turned, chain).run();
  contact.memory.axis = exchanged(contact.memory.axis);
  std::swap(contact.feature_a, contact.feature_b);
  if (chain != nullptr)
    for (std::size_t i = known; i < chain->size(); ++i) (*chain)[i].axis = *exchanged((*chain)[i].axis);
  return contact;
}

}  // namespace trajet
