#include "plot_file.hpp"

#include "trajet/error.hpp"

namespace trajet {

namespace {

FigureFormat format_of(const std::string& path) {
  const std::optional<FigureFormat> format = figure_format(path);
  if (!format) throw InputError({"--plot"}, "a file name that ends in .svg, .png or .pdf expected, got '" + path + "'");
  return *format;
}

}  // namespace

PlotFile::PlotFile(const std::string& path) : path_(path), format_(format_of(path)) { require_gnuplot(); }

void PlotFile::write(const Figure& figure) {
  file_->write(draw(figure, format_));
  file_->finish();
}

}  // namespace trajet
