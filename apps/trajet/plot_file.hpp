#pragma once

#include <optional>
#include <string>

#include "trajet/io/output_file.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet {

/// The file that `--plot` names.
class PlotFile {
 public:
  /// Looks at the name and for gnuplot, and touches nothing yet. Throws InputError for a name that ends in no known
  /// format, FileError without gnuplot.
  explicit PlotFile(const std::string& path);

  /// Creates or truncates the file.
  void open() { file_.emplace(path_); }
  void write(const Figure& figure);

 private:
  std::string path_;
  FigureFormat format_;
  std::optional<OutputFile> file_;
};

}  // namespace trajet
