#include "trajet/math/complementarity.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace trajet {
namespace {

using Matrix = Eigen::MatrixX<Extended>;
using Vector = Eigen::VectorX<Extended>;

/// A column is one more than others give if so much of its square is apart from them: far above rounding.
constexpr double kIndependent = 1e-16;
/// What is asked of a column that others give, and is left of that, may be so much of what is asked of all.
constexpr double kUnasked = 1e-6;

class ActiveSet {
 public:
  ActiveSet(const Matrix& A, const Vector& q) : A_(A), q_(q), x_(Vector::Zero(q.size())) {}

  const Vector& x() const { return x_; }
  Vector w() const { return q_ + A_ * x_; }
  bool holds(Eigen::Index i) const { return std::find(held_.begin(), held_.end(), i) != held_.end(); }

  /// Takes a component in and goes as far as all stay positive. False if the set gives its column already.
  bool take(Eigen::Index i) {
    held_.push_back(i);
    std::sort(held_.begin(), held_.end());
    if (!factorize()) {
      std::erase(held_, i);
      return false;
    }
    while (true) {
      const Vector z = solve();
      // how far towards z
      Extended part = 1;
      std::optional<std::size_t> first;
      for (std::size_t k = 0; k < held_.size(); ++k) {
        const Extended from = x_[held_[k]], to = z[static_cast<Eigen::Index>(k)];
        if (to > Extended(0)) continue;
        const Extended reach = from > Extended(0) ? from / (from - to) : Extended(0);
        if (first && reach >= part) continue;
        part = reach;
        first = k;
      }
      for (std::size_t k = 0; k < held_.size(); ++k)
        x_[held_[k]] += part * (z[static_cast<Eigen::Index>(k)] - x_[held_[k]]);
      if (!first) return holds(i);
      x_[held_[*first]] = 0;
      held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(*first));
      factorize();
    }
  }

 private:
  bool factorize() {
    const auto n = static_cast<Eigen::Index>(held_.size());
    Matrix part(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        part(i, j) = A_(held_[static_cast<std::size_t>(i)], held_[static_cast<std::size_t>(j)]);
    factor_.compute(part);
    if (n == 0) return true;
    return factor_.info() == Eigen::Success && factor_.vectorD().minCoeff() > Extended(kIndependent);
  }

  Vector solve() const {
    Vector right(static_cast<Eigen::Index>(held_.size()));
    for (std::size_t k = 0; k < held_.size(); ++k) right[static_cast<Eigen::Index>(k)] = -q_[held_[k]];
    return factor_.solve(right);
  }

  const Matrix& A_;
  const Vector& q_;
  Vector x_;
  std::vector<Eigen::Index> held_;
  Eigen::LDLT<Matrix> factor_;
};

}  // namespace

std::optional<Vector> solve_complementarity(const Matrix& A, const Vector& q, Extended tolerance) {
  const Eigen::Index n = q.size();
  Vector scale(n);
  // by powers of two, which round nothing
  for (Eigen::Index i = 0; i < n; ++i) scale[i] = std::ldexp(Extended(1), -std::ilogb(A(i, i)) / 2);
  const Matrix scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Vector right = scale.cwiseProduct(q);
  ActiveSet set(scaled, right);
  // each set that is gone back to has a lesser value: there are not so many
  const Eigen::Index most = 16 * n + 64;
  for (Eigen::Index round = 0; round < most; ++round) {
    const Vector w = set.w();
    Eigen::Index next = -1;
    bool is_met = true;
    std::vector<Eigen::Index> order;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!set.holds(i) && w[i] < -tolerance * scale[i]) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return w[a] < w[b]; });
    for (const Eigen::Index i : order) {
      is_met = false;
      if (!set.take(i)) continue;
      next = i;
      break;
    }
    const bool is_all_but_met = next < 0 && w.minCoeff() >= -Extended(kUnasked) * right.cwiseAbs().maxCoeff();
    if (is_met || is_all_but_met) return scale.cwiseProduct(set.x());
    if (next < 0) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace trajet
