#include "trajet/geom/unit_inertia.hpp"

#include <variant>

#include "trajet/geom/compound.hpp"

namespace trajet {

std::optional<Matrix3> unit_inertia(const Solid& solid) {
  if (const auto* disk = std::get_if<RoundPlate>(&solid)) {
    // I_z = r^2/2, and by the theorem of perpendicular axes I_x = I_y = I_z/2
    const double square = disk->radius * disk->radius;
    return Matrix3(Vector3(0.25 * square, 0.25 * square, 0.5 * square).asDiagonal());
  }
  if (const auto* compound = std::get_if<Compound>(&solid)) return compound->parts->unit_inertia;
  const std::optional<VolumeProperties> properties = volume_properties(solid);
  if (!properties) return std::nullopt;
  return Matrix3(properties->inertia / properties->volume);
}

}  // namespace trajet
