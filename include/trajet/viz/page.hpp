#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/error.hpp"
#include "trajet/sim/motion_record.hpp"

namespace trajet {

/// One run on the page. The first is the motion itself, further ones are shown beside it as ghosts.
struct PageRun {
  const RecordedMotion& motion;
  /// Writes its JSON report, part by part: docs/formats/report.md.
  std::function<void(const std::function<void(std::string_view)>& write)> report;
};

struct PageOptions {
  /// The number of a page that asks its server for another version of itself, and reloads when there is one; 0: it does
  /// not.
  long live_version = 0;
  std::string scene_text;  ///< the scene as its author wrote it, to be read on the page; empty: there is none
};

/// Why the page cannot be shown in this build of trajet; empty where it can.
std::string page_unavailable();

/// A self-contained HTML page that plays the runs: docs/formats/page.md. Throws FileError where this build has no page.
///
/// `write` gets the page part by part: the memory that is needed beside the runs does not grow with them.
void write_page(const std::vector<PageRun>& runs, const PageOptions& options,
                const std::function<void(std::string_view)>& write);

/// The same in one text.
std::string page_html(const std::vector<PageRun>& runs, const PageOptions& options = {});

/// The same page, showing what is wrong with a scene, `text`, at its place. Throws like `page_html`.
std::string error_page_html(const InputError& error, const std::string& text, const PageOptions& options = {});

}  // namespace trajet
