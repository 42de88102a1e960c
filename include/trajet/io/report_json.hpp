#pragma once

#include <string>

#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The JSON report of a run: docs/formats/report.md. Numbers read back as the same doubles; what is not finite is
/// `null`.
std::string report_json(const RunResult& result);

}  // namespace trajet
