#pragma once

#include <string_view>

#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The word for it in reports: `finished`, `stopped`, `failed`, `interrupted`.
std::string_view name(RunStatus status);
/// The word for it in reports: `hit`, `graze`, `rest`, `leave`.
std::string_view name(ImpactKind kind);
/// The word for it in reports: `vertex`, `edge`, `face`, `surface`.
std::string_view name(Feature feature);

}  // namespace trajet
