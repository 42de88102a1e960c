#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include "trajet/ensemble/sweep_summary.hpp"

namespace trajet {

/// The table of a sweep that grows block by block, with a journal beside it, FILE.journal, from which a sweep that was
/// killed at any moment goes on.
///
/// The journal says of each block that is complete where it ends in the table, and its checksum (CRC-32). What stands
/// behind the last complete block is cut off when the sweep goes on. A sweep that is complete has no journal.
class SweepFile {
 public:
  /// `fingerprint`, one line, tells sweeps apart: only one of the same goes on. Throws FileError where the file cannot
  /// be made, where it holds an unfinished sweep and `resume` is false, or that of another one and `resume` is true.
  SweepFile(std::string path, const std::string& fingerprint, const std::string& header_line, bool resume);
  SweepFile(const SweepFile&) = delete;
  SweepFile& operator=(const SweepFile&) = delete;
  ~SweepFile();

  /// Of what was there already: number of rows, and what is known of them.
  const SweepTally& found() const { return found_; }
  /// Whether it was complete already; then nothing can be appended.
  bool is_complete() const { return table_ == nullptr; }
  /// Calls `use` with each row's line, without its end, in their order.
  void each_line(const std::function<void(std::string_view)>& use) const;

  /// Rows that are complete lines. They are there, whatever becomes of the program, when this returns.
  void append(std::string_view lines, const SweepTally& tally);
  /// The sweep is complete.
  void finish();

 private:
  void create(const std::string& fingerprint, const std::string& header_line);
  void go_on(const std::string& fingerprint, const std::string& header_line);
  [[noreturn]] void fail(const std::string& path) const;

  std::string path_;
  std::string journal_path_;
  std::FILE* table_ = nullptr;
  std::FILE* journal_ = nullptr;
  std::uint64_t size_ = 0;
  SweepTally found_;
};

}  // namespace trajet
