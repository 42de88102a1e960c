#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sweep_setup.hpp"
#include "trajet/ensemble/sweep_summary.hpp"

namespace trajet {

/// One of several processes that `mpirun` has started for the same command.
struct Rank {
  int number = 0;
  int count = 1;
  std::string job;  ///< tells this start of all of them from others
};

/// What the environment says of it: Open MPI's variables, or those of the process managers of MPICH and Intel; none
/// where the program runs alone.
std::optional<Rank> rank_of_environment();

/// A sweep in parts that several processes compute, on one machine or on several that share a folder.
///
/// The parts lie in FILE.parts/, each a table with its journal (SweepFile). Whoever creates the claim of a part first
/// computes it: a process that is slow takes fewer. What a process that was lost has left is gone on with at the next
/// start. How the motions are parted does not depend on the number of processes.
class SweepParts {
 public:
  /// Whether parts of that table lie beside it.
  static bool exist(const std::string& table);

  /// `table`: the whole table, beside which the parts lie.
  SweepParts(const SweepSetup& setup, const std::string& table, const Rank& rank, bool resume);

  /// Computes parts until none is left that nobody has. False where `should_stop` has ended it.
  bool compute(int threads, const std::function<bool()>& should_stop);
  /// Waits until all parts are complete. False where `should_stop` has ended it.
  bool wait(const std::function<bool()>& should_stop) const;
  /// Calls `use` with the lines and the tally of each part, in their order, from that motion on.
  void each(std::uint64_t first,
            const std::function<void(const std::string& lines, const SweepTally& tally)>& use) const;
  /// Removes the parts once all processes have begun: none shall begin them anew.
  void remove() const;

 private:
  std::uint64_t begin(std::uint64_t part) const;
  std::string path(std::uint64_t part) const;
  bool claim(std::uint64_t part) const;
  bool is_complete(std::uint64_t part) const;
  /// The file that tells that a process has begun.
  std::string presence_of(int rank) const;

  const SweepSetup& setup_;
  std::string folder_;
  Rank rank_;
  std::uint64_t part_size_ = 0;
  std::uint64_t part_count_ = 0;
};

}  // namespace trajet
