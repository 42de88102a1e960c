#pragma once

#include <string>

#include "trajet/io/sweep_results.hpp"

namespace trajet {

/// What a sweep comes to, for people: a table of the columns, what was hit how often, how impacts scatter.
std::string sweep_text(const std::string& title, const SweepSummary& summary, bool color, int width);

}  // namespace trajet
