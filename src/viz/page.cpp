#include "trajet/viz/page.hpp"

#include "page_data.hpp"
#include "page_template.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using Json = nlohmann::ordered_json;

/// JSON that can stand inside an HTML script element: `<` occurs in strings only, where it may be escaped.
std::string for_script(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string fill_template(Json data, const PageOptions& options) {
  if (!page_unavailable().empty()) throw FileError(page_unavailable());
  data["trajet"] = kVersion;
  data["live"] = options.live_version;
  constexpr std::string_view kMark = "id=\"trajet-data\">";
  const std::string_view page = detail::kPageTemplate;
  const std::size_t begin = page.find(kMark) + kMark.size();
  const std::size_t end = page.find("</script>", begin);
  return std::string(page.substr(0, begin)) + for_script(data) + std::string(page.substr(end));
}

}  // namespace

std::string page_unavailable() {
  if (!detail::kPageTemplate.empty()) return {};
  return "this trajet was built without the page: " + std::string(detail::kPageMissing);
}

std::string page_html(const std::vector<PageRun>& runs, const PageOptions& options) {
  Json data = {{"scene_text", options.scene_text}, {"runs", Json::array()}};
  for (const PageRun& run : runs) data["runs"].push_back(detail::page_data(run));
  return fill_template(std::move(data), options);
}

std::string error_page_html(const InputError& error, const std::string& text, const PageOptions& options) {
  return fill_template({{"error",
                         {{"file", error.where().file.str()},
                          {"line", error.where().line},
                          {"column", error.where().column},
                          {"message", error.message()},
                          {"text", text}}}},
                       options);
}

}  // namespace trajet
