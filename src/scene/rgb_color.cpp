#include "trajet/scene/rgb_color.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <vector>

#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

namespace {

struct NamedColor {
  std::string_view name;
  RgbColor color;
};

constexpr std::array<NamedColor, 17> kColors{{{"aqua", {0x00, 0xff, 0xff}},
                                              {"black", {0x00, 0x00, 0x00}},
                                              {"blue", {0x00, 0x00, 0xff}},
                                              {"fuchsia", {0xff, 0x00, 0xff}},
                                              {"gray", {0x80, 0x80, 0x80}},
                                              {"green", {0x00, 0x80, 0x00}},
                                              {"lime", {0x00, 0xff, 0x00}},
                                              {"maroon", {0x80, 0x00, 0x00}},
                                              {"navy", {0x00, 0x00, 0x80}},
                                              {"olive", {0x80, 0x80, 0x00}},
                                              {"orange", {0xff, 0xa5, 0x00}},
                                              {"purple", {0x80, 0x00, 0x80}},
                                              {"red", {0xff, 0x00, 0x00}},
                                              {"silver", {0xc0, 0xc0, 0xc0}},
                                              {"teal", {0x00, 0x80, 0x80}},
                                              {"white", {0xff, 0xff, 0xff}},
                                              {"yellow", {0xff, 0xff, 0x00}}}};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

std::string color_text(const RgbColor& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color.red, color.green, color.blue);
  return text;
}

std::optional<RgbColor> find_color(std::string_view text) {
  const std::string wanted = lower(text);
  if (const auto* named = ranges::find(kColors, wanted, &NamedColor::name); named != kColors.end()) return named->color;
  constexpr std::string_view kDigits = "0123456789abcdef";
  if (wanted.size() != 7 || wanted.front() != '#') return std::nullopt;
  std::uint8_t parts[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t high = kDigits.find(wanted[2 * i + 1]), low = kDigits.find(wanted[2 * i + 2]);
    if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
    parts[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return RgbColor{parts[0], parts[1], parts[2]};
}

std::string unknown_color(const std::string& text) {
  std::vector<std::string_view> names;
  std::string list;
  for (const NamedColor& each : kColors) {
    names.push_back(each.name);
    list += (list.empty() ? "" : ", ") + std::string(each.name);
  }
  return "a colour expected, \"#rrggbb\" or one of " + list + "; got '" + text + "'" + did_you_mean(text, names);
}

}  // namespace trajet
