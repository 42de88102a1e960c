#include "svg_names.hpp"

#include <algorithm>
#include <string_view>

namespace trajet::detail {

namespace {

constexpr std::string_view kBegin = "<title>", kEnd = "</title>";

std::string element(const std::string& text) { return std::string(kBegin) + text + std::string(kEnd); }

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (static_cast<unsigned char>(c) < ' ')
      result += ' ';
    else
      result += c;
  }
  return result;
}

/// What stands between the tags of a piece of XML.
std::string words(std::string_view xml) {
  std::string result;
  bool is_in_tag = false;
  for (const char c : xml) {
    if (c == '<') is_in_tag = true;
    if (!is_in_tag) result += c;
    if (c == '>') is_in_tag = false;
  }
  return result;
}

/// The legend's text for the curve that begins at the start of `svg`: it comes before what is drawn.
std::string legend(std::string_view svg) {
  const std::size_t begin = svg.find("<text>");
  for (const std::string_view drawn : {"<path", "<polygon", "<use", "<g id="})
    if (svg.find(drawn) < begin) return {};
  if (begin == std::string_view::npos) return {};
  return words(svg.substr(begin, svg.find("</text>", begin) - begin));
}

}  // namespace

std::string with_names(const std::string& svg, const std::string& title) {
  std::string result;
  std::size_t done = 0;
  bool is_first = true;
  for (std::size_t begin = svg.find(kBegin); begin != std::string::npos; begin = svg.find(kBegin, done)) {
    result.append(svg, done, begin - done);
    done = std::min(svg.find(kEnd, begin), svg.size() - kEnd.size()) + kEnd.size();
    const std::string name = is_first ? escaped(title) : legend(std::string_view(svg).substr(done));
    if (!name.empty()) result += element(name);
    is_first = false;
  }
  return result.append(svg, done);
}

}  // namespace trajet::detail
