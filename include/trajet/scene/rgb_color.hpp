#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trajet {

/// What a body or an obstacle is painted with, in the sRGB space of screens.
struct RgbColor {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const RgbColor&, const RgbColor&) = default;
};

/// `#rrggbb`.
std::string color_text(const RgbColor& color);

/// The colour that a text names, whatever its case: `#rrggbb`, or one of the seventeen names of CSS 2.1 (`red`, `teal`,
/// …); nothing for other texts.
std::optional<RgbColor> find_color(std::string_view text);

/// What is wrong with a text that names no colour: a sentence for the user.
std::string unknown_color(const std::string& text);

}  // namespace trajet
