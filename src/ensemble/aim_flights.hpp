#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "passages.hpp"
#include "trajet/ensemble/aim.hpp"
#include "varied_scene.hpp"

namespace trajet {

/// Values of the unknowns, each from 0 at the low end of its range to 1 at the high end.
using AimPlace = std::vector<double>;

/// What aiming needs of the motion at one place.
struct AimFlight {
  std::vector<Passage> passages{};  ///< in the order of time; none where the numbers failed at once
  std::vector<double> contacts{};   ///< times of impacts with the target, s since the start
  double start_miss = 0.0;          ///< m; infinite where nothing is known
  double end_time = 0.0;            ///< s since the start
  bool ends_by_clock = false;       ///< the run has reached the scene's end
  double tolerance = 0.0;           ///< m: misses as small are hits, as far as the method's numbers tell

  /// The passage of that label, null if there is none.
  const Passage* passage(const std::string& label) const;
  /// The passage that comes nearest, null if there is none.
  const Passage* nearest() const;
};

/// Computes the motions of a task, each once.
class AimFlights {
 public:
  /// The task outlives this. Throws InputError where it is wrong.
  explicit AimFlights(const AimTask& task);

  const AimTask& task() const { return task_; }
  std::size_t dimension() const { return task_.unknowns.size(); }
  const std::string& body() const { return body_; }
  /// Where the scene's clock starts, s.
  double epoch() const { return epoch_; }

  /// SI, of the unknowns.
  std::vector<double> values(const AimPlace& place) const;
  /// Stays valid.
  const AimFlight& at(const AimPlace& place);
  const std::map<AimPlace, AimFlight>& all() const { return flights_; }

  long count() const { return static_cast<long>(flights_.size()); }
  long failed() const { return failed_; }
  const std::string& failure() const { return failure_; }  ///< of the first motion that failed

 private:
  AimFlight compute(const AimPlace& place);

  const AimTask& task_;
  std::string body_;
  VariedScene varied_;
  double epoch_ = 0.0;
  std::map<AimPlace, AimFlight> flights_;
  long failed_ = 0;
  std::string failure_;
};

/// The body of that name, or the only one. Throws InputError.
std::string aimed_body(const AimTask& task);

/// What the target does to the body that comes to it, in that world, from now on.
void set_on_hit(World& world, const std::string& target, OnHit on_hit);

}  // namespace trajet
