#include "trajet/geom/compound.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

namespace trajet {

Compound make_compound(std::vector<CompoundPart> parts) {
  if (parts.empty()) throw std::domain_error("a compound needs at least one part");
  double volume = 0.0, mass = 0.0;
  bool have_densities = true;
  Vector3 first = Vector3::Zero();
  std::vector<VolumeProperties> own;
  for (const CompoundPart& part : parts) {
    const std::optional<VolumeProperties> properties = volume_properties(part.solid);
    if (!properties) throw std::domain_error("every part of a compound needs a volume");
    own.push_back(*properties);
    const double part_mass = part.density.value_or(1.0) * properties->volume;
    have_densities = have_densities && part.density.has_value();
    volume += properties->volume;
    mass += part_mass;
    first += part_mass * part.p_BP;
  }
  const Vector3 center = first / mass;
  Matrix3 inertia = Matrix3::Zero();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    CompoundPart& part = parts[i];
    part.p_BP -= center;
    // Steiner: I + m (|p|^2 1 - p p^T)
    const double density = part.density.value_or(1.0), part_mass = density * own[i].volume;
    inertia += density * part.R_BP * own[i].inertia * part.R_BP.transpose() +
               part_mass * (part.p_BP.squaredNorm() * Matrix3::Identity() - part.p_BP * part.p_BP.transpose());
  }
  CompoundParts result{std::move(parts), {volume, Vector3::Zero(), volume / mass * inertia}, std::nullopt, -center};
  if (have_densities) result.mass = mass;
  return {std::make_shared<const CompoundParts>(std::move(result))};
}

}  // namespace trajet
