#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "aim_search.hpp"

namespace trajet {
namespace {

/// The square of the least miss around a place: a parabola through it and what lies at that distance along each
/// unknown, and along each two.
class Neighbourhood {
 public:
  Neighbourhood(AimFlights& flights, const Eigen::VectorXd& middle, double h)
      : flights_(flights), n_(middle.size()), h_(h) {
    // where an end of the ranges is nearer, the parabola lies beside the place
    middle_ = middle.cwiseMax(h).cwiseMin(1.0 - h);
    const double at_middle = value(middle_);
    gradient_ = Eigen::VectorXd::Zero(n_);
    curvature_ = Eigen::MatrixXd::Zero(n_, n_);
    Eigen::VectorXd ahead(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      ahead[i] = value(middle_ + h * Eigen::VectorXd::Unit(n_, i));
      const double behind = value(middle_ - h * Eigen::VectorXd::Unit(n_, i));
      gradient_[i] = (ahead[i] - behind) / (2.0 * h);
      curvature_(i, i) = (ahead[i] - 2.0 * at_middle + behind) / (h * h);
    }
    for (Eigen::Index i = 0; i < n_; ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const double both = value(middle_ + h * (Eigen::VectorXd::Unit(n_, i) + Eigen::VectorXd::Unit(n_, j)));
        curvature_(i, j) = curvature_(j, i) = (both - ahead[i] - ahead[j] + at_middle) / (h * h);
      }
  }

  /// Looks where the parabola is least, but not farther than 4 h.
  void look_at_least() {
    if (!gradient_.allFinite() || !curvature_.allFinite()) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(curvature_);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const Eigen::VectorXd axis = axes.eigenvectors().col(i);
      const double rate = axis.dot(gradient_), bend = axes.eigenvalues()[i];
      const double farthest = 4.0 * h_;
      const double along = bend > 0.0 ? -rate / bend : std::copysign(farthest, -rate);
      step += std::clamp(along, -farthest, farthest) * axis;
    }
    value((middle_ + step).cwiseMax(0.0).cwiseMin(1.0));
  }

  const Eigen::VectorXd& best() const { return best_; }
  double least() const { return least_; }

 private:
  double value(const Eigen::VectorXd& x) {
    const double miss = least_miss(flights_.at({x.data(), x.data() + n_}));
    if (miss * miss < least_) {
      least_ = miss * miss;
      best_ = x;
    }
    return miss * miss;
  }

  AimFlights& flights_;
  Eigen::Index n_;
  double h_;
  Eigen::VectorXd middle_, best_, gradient_;
  Eigen::MatrixXd curvature_;
  double least_ = INFINITY;
};

}  // namespace

double least_miss(const AimFlight& flight) {
  const Passage* nearest = flight.nearest();
  return nearest != nullptr ? std::min(nearest->miss, flight.start_miss) : flight.start_miss;
}

AimPlace find_closest(AimFlights& flights, const std::function<bool()>& should_stop) {
  AimPlace best;
  double least = INFINITY;
  for (const auto& [place, flight] : flights.all()) {
    if (!(least_miss(flight) < least)) continue;
    least = least_miss(flight);
    best = place;
  }
  if (best.empty()) return best;
  // the miss there is right to the square of the last distance: all digits that it has
  constexpr double kFirst = 1.0 / 128.0, kLast = 2e-5;
  constexpr int kMostMoves = 8;
  for (double h = kFirst; h > kLast; h *= 0.25)
    for (int move = 0; move < kMostMoves && !should_stop(); ++move) {
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(best.data(), static_cast<Eigen::Index>(best.size()));
      Neighbourhood around(flights, x, h);
      around.look_at_least();
      if (!(around.least() < least * least)) break;
      const double moved = (around.best() - x).cwiseAbs().maxCoeff();
      least = std::sqrt(around.least());
      best.assign(around.best().data(), around.best().data() + around.best().size());
      if (moved < h) break;
    }
  return best;
}

}  // namespace trajet
