#include "trajet/collide/respond/plastic_group.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

/// The impulses along some of the normals, at most three, that take out of the velocity all that is along them.
template <int Count>
Eigen::Matrix<double, Count, 1> impulses_of(const std::vector<Vector3>& normals, const std::size_t* held,
                                            const Vector3& velocity) {
  Eigen::Matrix<double, Count, Count> gram;
  Eigen::Matrix<double, Count, 1> approach;
  for (int i = 0; i < Count; ++i) {
    approach[i] = -normals[held[i]].dot(velocity);
    for (int j = 0; j < Count; ++j) gram(i, j) = normals[held[i]].dot(normals[held[j]]);
  }
  return gram.fullPivLu().solve(approach);
}

/// Tries which surfaces hold the body and keeps those that come nearest to what is asked.
class Search {
 public:
  Search(const std::vector<Vector3>& normals, const Vector3& velocity)
      : normals_(normals), velocity_(velocity), best_(normals.size(), 0.0), tried_(normals.size()) {
    least_ = violation(best_, {});
  }

  template <int Count>
  void try_all() {
    std::array<std::size_t, Count> held;
    try_behind<Count>(held, 0, 0);
  }

  const std::vector<double>& best() const { return best_; }

 private:
  template <int Count>
  void try_behind(std::array<std::size_t, Count>& held, std::size_t chosen, std::size_t from) {
    if (chosen < Count) {
      for (held[chosen] = from; held[chosen] < normals_.size() && !is_found(); ++held[chosen])
        try_behind<Count>(held, chosen + 1, held[chosen] + 1);
      return;
    }
    const auto impulses = impulses_of<Count>(normals_, held.data(), velocity_);
    if (!impulses.allFinite() || (impulses.array() < 0.0).any()) return;
    std::fill(tried_.begin(), tried_.end(), 0.0);
    for (int i = 0; i < Count; ++i) tried_[held[static_cast<std::size_t>(i)]] = impulses[i];
    const double wrong = violation(tried_, held);
    if (wrong >= least_) return;
    least_ = wrong;
    best_ = tried_;
  }

  bool is_found() const { return least_ <= 64.0 * kUnitRoundoff * velocity_.norm(); }

  /// The speed at which the body still approaches a surface, or moves against one that holds it, m/s.
  double violation(const std::vector<double>& impulses, std::span<const std::size_t> held) const {
    Vector3 after = velocity_;
    for (std::size_t i = 0; i < normals_.size(); ++i) after += impulses[i] * normals_[i];
    double worst = 0.0;
    for (const Vector3& normal : normals_) worst = std::max(worst, -after.dot(normal));
    for (const std::size_t i : held) worst = std::max(worst, std::abs(after.dot(normals_[i])));
    return worst;
  }

  const std::vector<Vector3>& normals_;
  const Vector3& velocity_;
  std::vector<double> best_;
  std::vector<double> tried_;
  double least_ = 0.0;
};

}  // namespace

std::vector<double> plastic_impulses(const std::vector<Vector3>& normals, const Vector3& velocity) {
  // Three surfaces with independent normals are enough to hold a body in space.
  Search search(normals, velocity);
  search.try_all<1>();
  search.try_all<2>();
  search.try_all<3>();
  return search.best();
}

}  // namespace trajet
