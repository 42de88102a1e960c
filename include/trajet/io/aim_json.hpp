#pragma once

#include <string>

#include "trajet/ensemble/aim.hpp"

namespace trajet {

/// What has come of aiming, as JSON: docs/formats/aim.md.
std::string aim_json(const AimTask& task, const AimResult& result);

/// `found`, `unreachable` or `not_converged`.
std::string name(AimStatus status);

}  // namespace trajet
