#pragma once

#include <string>

#include "trajet/study/compare.hpp"

namespace trajet {

/// The JSON report of a comparison: docs/formats/compare.md. Numbers read back as the same doubles; what is not known
/// is `null`.
std::string compare_json(const Comparison& comparison);

/// The same rows as CSV, one line for each method with each step or tolerance; what is not known is empty.
std::string compare_csv(const Comparison& comparison);

}  // namespace trajet
