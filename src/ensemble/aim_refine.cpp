#include <algorithm>
#include <array>
#include <cmath>

#include "aim_search.hpp"

namespace trajet {
namespace {

Eigen::VectorXd vector_of(const AimPlace& place) {
  return Eigen::Map<const Eigen::VectorXd>(place.data(), static_cast<Eigen::Index>(place.size()));
}
AimPlace place_of(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

}  // namespace

bool slopes_at(AimFlights& flights, const std::string& label, const AimPlace& place, double step,
               const MissFrame& frame, LinearMiss& model) {
  const Passage* here = flights.at(place).passage(label);
  if (here == nullptr) return false;
  model.value = frame(*here);
  model.slope.resize(2, static_cast<Eigen::Index>(place.size()));
  for (std::size_t i = 0; i < place.size(); ++i) {
    bool is_known = false;
    // away from the farther end; to the other side where the label ends on this one
    for (const double direction : place[i] < 0.5 ? std::array{1.0, -1.0} : std::array{-1.0, 1.0}) {
      AimPlace there = place;
      there[i] = std::clamp(place[i] + direction * step, 0.0, 1.0);
      const double moved = there[i] - place[i];
      const Passage* passage = moved == 0.0 ? nullptr : flights.at(there).passage(label);
      if (passage == nullptr) continue;
      model.slope.col(static_cast<Eigen::Index>(i)) = (frame(*passage) - model.value) / moved;
      is_known = true;
      break;
    }
    if (!is_known) return false;
  }
  return true;
}

RootOutcome refine_aim(AimFlights& flights, const std::string& label, AimPlace place, LinearMiss model,
                       const MissFrame& frame, AimRoot& root) {
  constexpr int kMostSteps = 60;
  constexpr int kMostHalvings = 12;
  constexpr int kMostFreshStarts = 4;
  const Passage* here = flights.at(place).passage(label);
  if (here == nullptr) return RootOutcome::stalled;
  Eigen::VectorXd x = vector_of(place);
  model.value = frame(*here);
  double miss = model.value.norm();
  double last_step = 1e-3;
  int fresh_starts = 0;
  bool is_at_edge = false;
  const auto tolerance = [&] { return flights.at(place).tolerance; };

  for (int n = 0; n < kMostSteps && miss > 0.0; ++n) {
    Eigen::VectorXd step = newton_step(model, x);
    bool has_helped = false, has_label = false;
    for (int halving = 0; halving < kMostHalvings; ++halving, step *= 0.5) {
      const Eigen::VectorXd next = (x + step).cwiseMax(0.0).cwiseMin(1.0);
      if (next == x) break;
      const AimPlace there = place_of(next);
      const Passage* passage = flights.at(there).passage(label);
      if (passage == nullptr) continue;
      has_label = true;
      const Eigen::Vector2d value = frame(*passage);
      const Eigen::VectorXd moved = next - x;
      // Broyden's: the smallest change of the slopes that makes them right along the step
      model.slope += (value - model.value - model.slope * moved) * moved.transpose() / moved.squaredNorm();
      if (value.norm() < miss) {
        has_helped = true;
        last_step = moved.cwiseAbs().maxCoeff();
        is_at_edge = (next.array() == 0.0 || next.array() == 1.0).any();
        x = next;
        place = there;
        model.value = value;
        miss = value.norm();
        break;
      }
      if (miss <= tolerance()) break;  // down to rounding
    }
    if (has_helped) continue;
    if (miss <= tolerance() || fresh_starts == kMostFreshStarts) break;
    ++fresh_starts;
    const double difference = std::clamp(0.1 * last_step, 1e-7, 1e-4);
    if (!slopes_at(flights, label, place, difference, frame, model)) break;
    last_step *= has_label ? 0.1 : 1.0;
  }

  here = flights.at(place).passage(label);
  if (here->residual.norm() <= tolerance()) {
    if (here->miss > tolerance()) return RootOutcome::none;  // blocked before it gets there
    root = {place, *here, false};
    return RootOutcome::root;
  }
  // a least miss that is not zero: the step to the model's zero does not exist
  const double reachable = (model.slope.transpose() * model.value).norm() / std::max(model.slope.norm() * miss, 1e-300);
  constexpr double kStationary = 1e-3;
  return reachable < kStationary || is_at_edge ? RootOutcome::none : RootOutcome::stalled;
}

}  // namespace trajet
