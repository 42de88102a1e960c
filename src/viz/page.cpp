#include "trajet/viz/page.hpp"

#include "page_data.hpp"
#include "page_template.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using Sink = std::function<void(std::string_view)>;

/// The page around the members of its data that `write_members` writes.
template <class WriteMembers>
void fill_template(const PageOptions& options, const Sink& write, const WriteMembers& write_members) {
  if (!page_unavailable().empty()) throw FileError(page_unavailable());
  constexpr std::string_view kMark = "id=\"trajet-data\">";
  const std::string_view page = detail::kPageTemplate;
  const std::size_t begin = page.find(kMark) + kMark.size();
  const std::size_t end = page.find("</script>", begin);
  write(page.substr(0, begin));
  detail::ScriptText text(write);
  text.add("{");
  write_members(text);
  text.add(R"(,"trajet":)");
  text.add_value(kVersion);
  text.add(R"(,"live":)" + std::to_string(options.live_version) + "}");
  text.finish();
  write(page.substr(end));
}

}  // namespace

std::string page_unavailable() {
  if (!detail::kPageTemplate.empty()) return {};
  return "this trajet was built without the page: " + std::string(detail::kPageMissing);
}

void write_page(const std::vector<PageRun>& runs, const PageOptions& options, const Sink& write) {
  fill_template(options, write, [&](detail::ScriptText& text) {
    text.add(R"("scene_text":)");
    text.add_value(options.scene_text);
    text.add(R"(,"runs":[)");
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (i > 0) text.add(",");
      detail::write_page_data(runs[i], text);
    }
    text.add("]");
  });
}

std::string page_html(const std::vector<PageRun>& runs, const PageOptions& options) {
  std::string html;
  write_page(runs, options, [&](std::string_view part) { html += part; });
  return html;
}

std::string error_page_html(const InputError& error, const std::string& scene_text, const PageOptions& options) {
  std::string html;
  fill_template(
      options, [&](std::string_view part) { html += part; },
      [&](detail::ScriptText& text) {
        text.add(R"("error":)");
        text.add_value({{"file", error.where().file.str()},
                        {"line", error.where().line},
                        {"column", error.where().column},
                        {"message", error.message()},
                        {"text", scene_text}});
      });
  return html;
}

}  // namespace trajet
