#pragma once

#include "script_text.hpp"
#include "trajet/viz/page.hpp"

namespace trajet::detail {

/// Writes what the page knows of a run: docs/formats/page.md.
void write_page_data(const PageRun& run, ScriptText& text);

}  // namespace trajet::detail
