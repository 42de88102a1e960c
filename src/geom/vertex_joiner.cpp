#include "trajet/geom/vertex_joiner.hpp"

#include <cstdint>
#include <stdexcept>

#include "mixed_bits.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

std::uint64_t hash(const Vector3& p) {
  std::uint64_t sum = 0;
  for (const double x : p) sum = detail::mixed(sum ^ bit_cast<std::uint64_t>(x + 0.0));  // one zero
  return sum;
}

}  // namespace

std::size_t VertexJoiner::slot_of(const Vector3& p) const {
  std::size_t slot = hash(p) & (table_.size() - 1);
  while (table_[slot] >= 0 && vertices_[static_cast<std::size_t>(table_[slot])] != p)
    slot = (slot + 1) & (table_.size() - 1);
  return slot;
}

int VertexJoiner::index(const Vector3& p) {
  if (!p.allFinite()) throw std::domain_error("the vertices must be finite");
  if (2 * vertices_.size() >= table_.size()) grow();
  int& place = table_[slot_of(p)];
  if (place < 0) {
    place = static_cast<int>(vertices_.size());
    vertices_.push_back(p);
  }
  return place;
}

void VertexJoiner::grow() {
  constexpr std::size_t kFewest = 16;
  table_.assign(table_.empty() ? kFewest : 2 * table_.size(), -1);
  for (std::size_t i = 0; i < vertices_.size(); ++i) table_[slot_of(vertices_[i])] = static_cast<int>(i);
}

}  // namespace trajet
