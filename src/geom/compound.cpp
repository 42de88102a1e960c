#include "trajet/geom/compound.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "trajet/geom/unit_inertia.hpp"

namespace trajet {

Compound make_compound(std::vector<CompoundPart> parts) {
  if (parts.empty()) throw std::domain_error("a compound needs at least one part");
  CompoundParts result;
  double mass = 0.0;
  bool have_masses = true;
  Vector3 first = Vector3::Zero();
  std::vector<double> masses;  // of a density of 1 kg/m^3 where a part has none of its own
  for (const CompoundPart& part : parts) {
    const std::optional<VolumeProperties> properties = volume_properties(part.solid);
    if (!properties && !part.mass)
      throw std::domain_error("every part of a compound needs a volume, or a mass as all others");
    if (properties) result.volume += properties->volume;
    masses.push_back(part.mass ? *part.mass : properties->volume);
    have_masses = have_masses && part.mass.has_value();
    mass += masses.back();
    first += masses.back() * part.p_BP;
  }
  const Vector3 center = first / mass;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    CompoundPart& part = parts[i];
    part.p_BP -= center;
    const std::optional<Matrix3> own = unit_inertia(part.solid);
    if (!own) throw std::domain_error("a part of a compound has neither volume nor area");
    // Steiner: I + m (|p|^2 1 - p p^T)
    result.unit_inertia += masses[i] / mass *
                           (part.R_BP * *own * part.R_BP.transpose() + part.p_BP.squaredNorm() * Matrix3::Identity() -
                            part.p_BP * part.p_BP.transpose());
  }
  result.parts = std::move(parts);
  result.origin = -center;
  if (have_masses) result.mass = mass;
  return {std::make_shared<const CompoundParts>(std::move(result))};
}

}  // namespace trajet
