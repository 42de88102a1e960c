#include "solid_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "frame_paths.hpp"
#include "trajet/collide/detect/parting.hpp"
#include "trajet/collide/detect/turning_contact.hpp"

namespace trajet {
namespace {

/// So many pieces are searched one by one; a stretch of time is as short as it meets no more.
constexpr std::size_t kFew = 8;

ContactResult result_of(const TurningContact& contact, const FramePath& body) {
  ContactResult result;
  result.status = contact.status;
  // a touch that closes at such a speed is none: within the resolution of round solids it would be over at once
  constexpr double kTouch = 1e-9;  // m
  const bool closes =
      contact.gap_rate < 0.0 && contact.gap_rate * contact.gap_rate > 4.0 * kTouch * std::abs(contact.gap_curvature);
  if (result.status == ContactStatus::graze && closes) result.status = ContactStatus::hit;
  result.time = contact.time;
  result.time_error_bound = contact.time_error_bound;
  result.time_resolution = contact.time_resolution;
  result.point = contact.point;
  result.normal = contact.normal;
  result.position = body.pose(contact.time).p_WB;
  result.side_before = 1;
  result.gap_rate = contact.gap_rate;
  result.gap_curvature = contact.gap_curvature;
  result.touched = TouchedFeatures{contact.feature_a, contact.feature_b, contact.points};
  return result;
}

/// Boxes around the pieces, in their frame.
BoxTree tree_of(const ConvexPieces& pieces) {
  std::vector<Aabb> boxes;
  for (const ConvexCore& piece : pieces) {
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      box.upper[i] = support(piece, Vector3::Unit(i)).height;
      box.lower[i] = -support(piece, -Vector3::Unit(i)).height;
    }
    boxes.push_back(grown(box, piece.rounding));
  }
  return BoxTree(boxes);
}

}  // namespace

SolidSearch::SolidSearch(const World& world)
    : world_(world), bodies_(world.bodies.size()), obstacles_(world.obstacles.size()) {}

const SolidSearch::Pieces& SolidSearch::pieces_of_body(int body) {
  auto& made = bodies_[static_cast<std::size_t>(body)];
  if (!made) {
    made = std::make_unique<Pieces>(Pieces{convex_pieces(world_.bodies[static_cast<std::size_t>(body)].solid)});
  }
  return *made;
}

const SolidSearch::Pieces& SolidSearch::pieces_of_obstacle(int index) {
  auto& made = obstacles_[static_cast<std::size_t>(index)];
  if (!made) {
    const World::Obstacle& obstacle = world_.obstacles[static_cast<std::size_t>(index)];
    made = std::make_unique<Pieces>(Pieces{convex_pieces(obstacle.solid)});
    if (made->cores.size() > kFew) made->tree = tree_of(made->cores);
  }
  return *made;
}

ContactResult SolidSearch::first_contact(int body_index, int obstacle_index, const Segment<>& motion,
                                         DrivenObstacle* driven, double from, double to, const ContactMemory& memory) {
  const World::Body& body = world_.bodies[static_cast<std::size_t>(body_index)];
  const World::Obstacle& obstacle = world_.obstacles[static_cast<std::size_t>(obstacle_index)];
  const Pieces& body_pieces = pieces_of_body(body_index);
  const Pieces& obstacle_pieces = pieces_of_obstacle(obstacle_index);
  const FramePath at_rest = FramePath::at_rest(obstacle.p_WB, obstacle.q_WB);
  const double direction = to < from ? -1.0 : 1.0;
  ContactResult result{.memory = memory};
  while (direction * (to - from) > 0.0) {
    const FramePath path = body_path(body, motion, from);
    const FramePath other = driven != nullptr ? driven->path(from, to) : at_rest;
    double end = direction * (to - path.t1()) > 0.0 ? path.t1() : to;
    if (driven != nullptr && direction * (end - other.t1()) > 0.0) end = other.t1();
    if (!(direction * (end - from) > 0.0))
      return {.status = ContactStatus::unresolved, .time = from, .memory = result.memory};
    result = search({body_pieces, obstacle_pieces, path, other, bounding_radius(body.solid)}, from, end, result.memory);
    if (result.status != ContactStatus::separated) return result;
    from = end;
  }
  return result;
}

ContactResult SolidSearch::first_contact_of_bodies(int first, const Segment<>& motion, int second,
                                                   const Segment<>& other_motion, double from, double to,
                                                   const ContactMemory& memory) {
  const World::Body& body = world_.bodies[static_cast<std::size_t>(first)];
  const World::Body& other = world_.bodies[static_cast<std::size_t>(second)];
  const double direction = to < from ? -1.0 : 1.0;
  ContactResult result{.memory = memory};
  while (direction * (to - from) > 0.0) {
    const FramePath path = body_path(body, motion, from), other_path = body_path(other, other_motion, from);
    const double end = direction * std::min({direction * to, direction * path.t1(), direction * other_path.t1()});
    if (!(direction * (end - from) > 0.0))
      return {.status = ContactStatus::unresolved, .time = from, .memory = result.memory};
    result = search({pieces_of_body(first), pieces_of_body(second), path, other_path, bounding_radius(body.solid)},
                    from, end, result.memory);
    if (result.status != ContactStatus::separated) return result;
    from = end;
  }
  return result;
}

ContactResult SolidSearch::search(const Stretch& stretch, double from, double to, const ContactMemory& memory) {
  if (memory.side < 0) return search_parting(stretch, from, to, memory);
  const std::vector<int> candidates = near(stretch, from, to);
  const double middle = from + 0.5 * (to - from);
  // a shorter stretch meets no fewer than the body is near to where it begins
  const bool is_walked = stretch.obstacle.tree && stretch.obstacle_path.is_at_rest();
  if (!is_walked || candidates.size() <= kFew || middle == from || middle == to ||
      candidates.size() <= kFew + 2 * near(stretch, from, from).size())
    return search_pieces(stretch, candidates, from, to, memory);
  const ContactResult first = search(stretch, from, middle, memory);
  return first.status == ContactStatus::separated ? search(stretch, middle, to, first.memory) : first;
}

ContactResult SolidSearch::search_pieces(const Stretch& stretch, std::span<const int> near, double from, double to,
                                         const ContactMemory& memory) {
  ContactResult result{.memory = memory};
  result.memory.side = 1;
  double end = to;
  for (int i = 0; i < static_cast<int>(stretch.body.cores.size()); ++i)
    for (const int j : near) {
      // the axis belongs to one pair of pieces
      const bool is_known = i == memory.body_piece && j == memory.obstacle_piece;
      const TurningMemory known{.axis = is_known ? memory.axis : std::nullopt,
                                .contact_time = memory.contact_time,
                                .tolerance = memory.tolerance,
                                .is_apart = memory.side > 0,
                                .direction = -memory.normal};
      const TurningContact found = trajet::first_contact(
          stretch.body.cores[static_cast<std::size_t>(i)], stretch.body_path,
          stretch.obstacle.cores[static_cast<std::size_t>(j)], stretch.obstacle_path, from, end, known);
      if (found.status == ContactStatus::separated) {
        if (!is_known || result.status != ContactStatus::separated) continue;
        result.memory.axis = found.memory.axis;
        result.memory.contact_time = found.memory.contact_time;
        continue;
      }
      result = result_of(found, stretch.body_path);
      result.memory = {.side = result.status == ContactStatus::graze ? 1 : -1,
                       .contact_time = found.memory.contact_time,
                       .tolerance = found.memory.tolerance,
                       .axis = found.memory.axis,
                       .body_piece = i,
                       .obstacle_piece = j,
                       .normal = found.normal};
      end = found.time;
      if (end == from) return result;
    }
  return result;
}

ContactResult SolidSearch::search_parting(const Stretch& stretch, double from, double to, const ContactMemory& memory) {
  const Parting parting = trajet::first_parting(stretch.body.cores, stretch.body_path, stretch.obstacle.cores,
                                                stretch.obstacle_path, from, to, memory.contact_time == from);
  ContactResult result{.memory = memory};
  if (parting.contact.status == ContactStatus::separated) return result;
  result = result_of(parting.contact, stretch.body_path);
  result.direction = ContactDirection::leaving;
  result.side_before = -1;
  result.normal = -parting.contact.normal;
  result.memory = {.side = 1,
                   .contact_time = parting.contact.memory.contact_time,
                   .tolerance = parting.contact.memory.tolerance,
                   .axis = parting.contact.memory.axis,
                   .body_piece = parting.piece_a,
                   .obstacle_piece = parting.piece_b,
                   .normal = parting.contact.normal};
  return result;
}

std::vector<int> SolidSearch::near(const Stretch& stretch, double from, double to) {
  std::vector<int> found;
  if (!stretch.obstacle.tree || !stretch.obstacle_path.is_at_rest()) {
    found.resize(stretch.obstacle.cores.size());
    std::iota(found.begin(), found.end(), 0);
    return found;
  }
  // the box of the body's way, in the obstacle's frame
  const FramePose pose = stretch.obstacle_path.pose(from);
  Vector3 middle, half;
  for (int i = 0; i < 3; ++i) {
    const Range range = stretch.body_path.range(i, from, to);
    middle[i] = 0.5 * (range.lower + range.upper);
    half[i] = 0.5 * (range.upper - range.lower);
  }
  const Vector3 center = pose.R_WB.transpose() * (middle - pose.p_WB);
  const Vector3 reach = Vector3::Constant(stretch.reach) + Vector3(pose.R_WB.transpose().cwiseAbs() * half);
  constexpr double kMargin = 1e-9;  // far above what the sums round to
  const Vector3 margin = kMargin * (reach + center.cwiseAbs());
  stretch.obstacle.tree->visit_overlapping({center - reach - margin, center + reach + margin}, [&](int index) {
    found.push_back(index);
    return true;
  });
  return found;
}

}  // namespace trajet
