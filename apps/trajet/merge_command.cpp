#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "message.hpp"
#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/sweep_csv.hpp"

namespace trajet {
namespace {

/// A table that is read line by line.
class ShardTable {
 public:
  explicit ShardTable(std::string path) : path_(std::move(path)), stream_(path_, std::ios::binary) {
    if (!stream_) throw FileError("cannot read " + path_);
    if (std::ifstream(path_ + ".journal"))
      throw FileError(path_ + " is a sweep that is not complete: --resume goes on with it");
    if (!std::getline(stream_, header_) || !header_.starts_with("index,"))
      throw FileError(path_ + " is no table of a sweep: index, ... expected in its first line");
    next();
  }

  const std::string& path() const { return path_; }
  const std::string& header() const { return header_; }
  /// The line that comes next, if there is one, and the number of its motion.
  const std::optional<std::string>& line() const { return line_; }
  std::uint64_t index() const { return index_; }
  void next() {
    std::string line;
    line_ = std::getline(stream_, line) ? std::optional(std::move(line)) : std::nullopt;
    if (line_) index_ = read_csv_row(*line_, 0).index;
  }

 private:
  std::string path_;
  std::ifstream stream_;
  std::string header_;
  std::optional<std::string> line_;
  std::uint64_t index_ = 0;
};

}  // namespace

int merge_command(const MergeArguments& arguments) {
  std::vector<ShardTable> tables;
  for (const std::string& path : arguments.files) {
    tables.emplace_back(path);
    if (tables.back().header() != tables.front().header())
      throw FileError(path + " has other columns than " + tables.front().path());
    if (path == arguments.out) throw InputError({"--out"}, "'" + path + "' is one of the tables");
  }
  OutputFile out(arguments.out);
  out.write(tables.front().header() + "\n");
  std::uint64_t expected = 0, gaps = 0;
  std::optional<std::uint64_t> last;
  while (true) {
    ShardTable* first = nullptr;
    for (ShardTable& table : tables)
      if (table.line() && (first == nullptr || table.index() < first->index())) first = &table;
    if (first == nullptr) break;
    if (last == first->index())
      throw FileError(fmt::format("motion {} is in {} and in another table", *last, first->path()));
    last = first->index();
    if (*last != expected) ++gaps;
    expected = *last + 1;
    out.write(*first->line() + "\n");
    first->next();
  }
  out.finish();
  if (gaps > 0) tell_warning(fmt::format("motions are missing in {} places: is a shard missing?", gaps));
  return kDone;
}

}  // namespace trajet
