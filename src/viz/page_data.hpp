#pragma once

#include <nlohmann/json.hpp>

#include "trajet/viz/page.hpp"

namespace trajet::detail {

/// What the page knows of a run: docs/formats/page.md.
nlohmann::ordered_json page_data(const PageRun& run);

}  // namespace trajet::detail
