#include "sweep_ranks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "sweep_tally.hpp"
#include "trajet/error.hpp"
#include "trajet/io/sweep_csv.hpp"
#include "trajet/io/sweep_file.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet {
namespace {

constexpr std::uint64_t kMostParts = 1024;
constexpr std::uint64_t kLeastMotions = 64;  // of a part
constexpr std::chrono::milliseconds kPause{5};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string folder_of(const std::string& table) { return table + ".parts"; }

}  // namespace

bool SweepParts::exist(const std::string& table) { return std::filesystem::exists(folder_of(table)); }

std::optional<Rank> rank_of_environment() {
  constexpr const char* kNames[][3] = {
      {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE"},
      {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_MCA_orte_hnp_uri"},
      {"PMI_RANK", "PMI_SIZE", "HYDRA_BSTRAP_PID"},
  };
  for (const auto& [rank, size, job] : kNames) {
    const std::optional<double> number = finite_number(variable(rank)), count = finite_number(variable(size));
    if (!number || !count || *count < 2.0) continue;
    std::string name = variable(job);
    if (name.empty()) continue;
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return Rank{static_cast<int>(*number), static_cast<int>(*count), std::move(name)};
  }
  return std::nullopt;
}

SweepParts::SweepParts(const SweepSetup& setup, const std::string& table, const Rank& rank, bool resume)
    : setup_(setup), folder_(folder_of(table)), rank_(rank) {
  const std::uint64_t count = setup.last - setup.first;
  part_size_ = std::max(kLeastMotions, (count + kMostParts - 1) / kMostParts);
  part_count_ = (count + part_size_ - 1) / part_size_;
  std::filesystem::create_directories(folder_);
  std::ofstream(presence_of(rank_.number)) << "";
  // all processes begin at once: the first of them writes whose folder it is
  const std::string mark = folder_ + "/job";
  const int file = open(mark.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0666);
  if (file >= 0) {
    const std::string line = rank_.job + "\n";
    const bool is_written = write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    close(file);
    if (!is_written) throw FileError("cannot write " + mark);
    return;
  }
  std::string job;
  std::getline(std::ifstream(mark), job);
  if (!resume && !job.empty() && job != rank_.job)
    throw FileError(folder_ +
                    " holds a sweep that is not complete: --resume goes on with it; to begin anew, remove it");
}

std::uint64_t SweepParts::begin(std::uint64_t part) const {
  return std::min(setup_.first + part * part_size_, setup_.last);
}

std::string SweepParts::path(std::uint64_t part) const { return fmt::format("{}/{:04}.csv", folder_, part); }

bool SweepParts::claim(std::uint64_t part) const {
  const std::string name = path(part) + "." + rank_.job;
  const int file = open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0666);
  if (file >= 0) close(file);
  return file >= 0;
}

bool SweepParts::is_complete(std::uint64_t part) const { return std::filesystem::exists(path(part) + ".complete"); }

std::string SweepParts::presence_of(int rank) const { return fmt::format("{}/{}.{}", folder_, rank_.job, rank); }

bool SweepParts::compute(int threads, const std::function<bool()>& should_stop) {
  const std::string header = csv_line(sweep_header(setup_.sweep, setup_.column_count));
  std::string lines;
  for (std::uint64_t part = 0; part < part_count_; ++part) {
    if (should_stop()) return false;
    if (is_complete(part) || !claim(part)) continue;
    SweepFile file(path(part), setup_.fingerprint, header, true);
    std::uint64_t done = file.found().count;
    run_sweep(
        setup_.sweep, {.first = begin(part) + done, .last = begin(part + 1), .threads = threads},
        [&](SweepBlock&& block) {
          lines.clear();
          for (const SweepRow& row : block.rows) append_csv_line(row, setup_.column_count, lines);
          file.append(lines, tally_of(block, setup_));
          done += block.rows.size();
          return true;
        },
        should_stop);
    if (begin(part) + done < begin(part + 1)) return false;
    std::ofstream(path(part) + ".complete") << "";
  }
  return true;
}

bool SweepParts::wait(const std::function<bool()>& should_stop) const {
  for (std::uint64_t part = 0; part < part_count_; ++part)
    while (!is_complete(part)) {
      if (should_stop()) return false;
      std::this_thread::sleep_for(kPause);
    }
  return true;
}

void SweepParts::each(std::uint64_t first,
                      const std::function<void(const std::string& lines, const SweepTally& tally)>& use) const {
  const std::string header = csv_line(sweep_header(setup_.sweep, setup_.column_count));
  for (std::uint64_t part = 0; part < part_count_; ++part) {
    if (begin(part) < first) continue;
    const SweepFile file(path(part), setup_.fingerprint, header, true);
    std::string lines;
    file.each_line([&](std::string_view line) {
      lines += line;
      lines += '\n';
    });
    use(lines, file.found());
  }
}

void SweepParts::remove() const {
  for (int rank = 0; rank < rank_.count; ++rank)
    while (!std::filesystem::exists(presence_of(rank))) std::this_thread::sleep_for(kPause);
  std::filesystem::remove_all(folder_);
}

}  // namespace trajet
