#include "trajet/io/sweep_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "trajet/error.hpp"

namespace trajet {
namespace {

std::uint32_t checksum(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

/// A line of the journal: where the block ends in the table, its checksum, its tally.
struct JournalLine {
  std::uint64_t end = 0;
  std::uint32_t checksum = 0;
  SweepTally tally{};

  std::string text() const {
    std::string result = fmt::format("{} {:08x} {} {} {}", end, checksum, tally.count, tally.failed, tally.condition);
    for (const auto& [name, count] : tally.hits) result += fmt::format(" {}={}", name, count);
    return result + " .\n";
  }
};

/// Nothing where the line was cut off.
std::optional<JournalLine> read_journal_line(const std::string& line) {
  std::istringstream stream(line);
  JournalLine result;
  stream >> result.end >> std::hex >> result.checksum >> std::dec >> result.tally.count >> result.tally.failed >>
      result.tally.condition;
  for (std::string word; stream >> word;) {
    if (word == ".") return result;
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return std::nullopt;
    std::istringstream(word.substr(equals + 1)) >> result.tally.hits[word.substr(0, equals)];
  }
  return std::nullopt;
}

}  // namespace

SweepFile::SweepFile(std::string path, const std::string& fingerprint, const std::string& header_line, bool resume)
    : path_(std::move(path)), journal_path_(path_ + ".journal") {
  const bool has_journal = std::filesystem::exists(journal_path_);
  if (!resume && has_journal)
    throw FileError(path_ + " holds a sweep that is not complete: --resume goes on with it; to begin anew, remove " +
                    journal_path_);
  if (resume && (has_journal || std::filesystem::exists(path_)))
    go_on(fingerprint, header_line);
  else
    create(fingerprint, header_line);
}

SweepFile::~SweepFile() {
  if (table_ != nullptr) std::fclose(table_);
  if (journal_ != nullptr) std::fclose(journal_);
}

void SweepFile::fail(const std::string& path) const {
  throw FileError("cannot write " + path + ": " + std::strerror(errno));
}

void SweepFile::create(const std::string& fingerprint, const std::string& header_line) {
  // the journal first: a table without one is complete
  journal_ = std::fopen(journal_path_.c_str(), "wb");
  if (journal_ == nullptr) fail(journal_path_);
  const std::string line = fingerprint + "\n";
  if (std::fwrite(line.data(), 1, line.size(), journal_) != line.size() || std::fflush(journal_) != 0)
    fail(journal_path_);
  table_ = std::fopen(path_.c_str(), "wb");
  if (table_ == nullptr) {
    std::filesystem::remove(journal_path_);
    fail(path_);
  }
  append(header_line, {});
}

void SweepFile::go_on(const std::string& fingerprint, const std::string& header_line) {
  const auto is_another = [this] {
    return FileError(path_ +
                     " is of another sweep (scene, values, columns, seed or version differ): it cannot go on here");
  };
  std::ifstream table(path_, std::ios::binary);
  std::ifstream journal(journal_path_, std::ios::binary);
  std::string line;
  if (!journal) {  // complete
    if (!std::getline(table, line) || line + "\n" != header_line) throw is_another();
    while (std::getline(table, line)) ++found_.count;
    return;
  }
  const bool is_begun = std::getline(journal, line) && !journal.eof();
  if (is_begun && line != fingerprint) throw is_another();
  std::string kept = fingerprint + "\n", block;
  while (is_begun && std::getline(journal, line)) {
    const std::optional<JournalLine> entry = read_journal_line(line);
    if (!entry || entry->end < size_) break;
    block.resize(entry->end - size_);
    if (!table.read(block.data(), static_cast<std::streamsize>(block.size())) || checksum(block) != entry->checksum)
      break;
    size_ = entry->end;
    found_.add(entry->tally);
    kept += line + "\n";
  }
  table.close();
  journal.close();
  if (size_ == 0) return create(fingerprint, header_line);
  std::filesystem::resize_file(path_, size_);
  table_ = std::fopen(path_.c_str(), "ab");
  if (table_ == nullptr) fail(path_);
  std::filesystem::resize_file(journal_path_, kept.size());
  journal_ = std::fopen(journal_path_.c_str(), "ab");
  if (journal_ == nullptr) fail(journal_path_);
}

void SweepFile::each_line(const std::function<void(std::string_view)>& use) const {
  std::ifstream table(path_, std::ios::binary);
  std::string line;
  std::getline(table, line);  // the header
  while (std::getline(table, line)) use(line);
}

void SweepFile::append(std::string_view lines, const SweepTally& tally) {
  if (std::fwrite(lines.data(), 1, lines.size(), table_) != lines.size() || std::fflush(table_) != 0) fail(path_);
  size_ += lines.size();
  const std::string entry = JournalLine{size_, checksum(lines), tally}.text();
  if (std::fwrite(entry.data(), 1, entry.size(), journal_) != entry.size() || std::fflush(journal_) != 0)
    fail(journal_path_);
}

void SweepFile::finish() {
  if (table_ == nullptr) return;
  const bool is_written = fsync(fileno(table_)) == 0 && std::fclose(table_) == 0;
  table_ = nullptr;
  if (!is_written) fail(path_);
  std::fclose(journal_);
  journal_ = nullptr;
  std::filesystem::remove(journal_path_);
}

}  // namespace trajet
