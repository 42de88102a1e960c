#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trajet {

enum class FigureFormat { svg, png, pdf };

/// The format that a file name ends in (`.svg`, `.png`, `.pdf`), or nothing.
std::optional<FigureFormat> figure_format(std::string_view path);

/// A size that suits the page of a report: 100 units are an inch of a PDF, a unit a pixel of an SVG and two of a PNG.
struct FigureSize {
  int width = 0;
  int height = 0;
};

/// The program that draws, or FileError that says how to get it.
void require_gnuplot();

/// A picture before it is drawn.
struct Figure {
  std::string script;  ///< lines for gnuplot, which know nothing of formats
  FigureSize size;
  std::string title;  ///< of the picture as a whole, for browsers and those who cannot see it
};

/// Draws: runs gnuplot, and returns the contents of the picture's file. Throws FileError with gnuplot's own words if it
/// fails.
std::string draw(const Figure& figure, FigureFormat format);

namespace detail {
/// A text as a literal of a gnuplot script; control characters become blanks.
std::string quoted(std::string_view text);
}  // namespace detail

}  // namespace trajet
