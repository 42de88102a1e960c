#include "trajet/math/complementarity.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace trajet {
namespace {

using Matrix = Eigen::MatrixX<Extended>;
using Vector = Eigen::VectorX<Extended>;

/// A column is one more than others give if so much of its square is apart from them: far above rounding.
constexpr double kIndependent = 1e-15;
/// A part of a direction so small is rounding.
constexpr double kNoPart = 1e-9;

/// Components that are positive, w being 0 there, and x.
class ActiveSet {
 public:
  enum class Step {
    forward,    ///< to where the value x . A x / 2 + q . x is less
    none,       ///< only rounding made it look as if there were a lesser one
    unbounded,  ///< the value has no least
  };

  ActiveSet(const Matrix& A, const Vector& q) : A_(A), q_(q), x_(Vector::Zero(q.size())) {}

  const Vector& x() const { return x_; }
  Vector w() const { return q_ + A_ * x_; }
  const std::vector<Eigen::Index>& held() const { return held_; }
  bool holds(Eigen::Index i) const { return std::find(held_.begin(), held_.end(), i) != held_.end(); }

  /// Takes a component in at which w < 0, and goes to where the value is least, as far as all stay positive.
  Step take(Eigen::Index i, Extended tolerance) {
    add(i);
    if (!factorize()) {
      remove(i);
      factorize();
      if (const Step step = exchange(i, tolerance); step != Step::forward) return step;
      factorize();
    }
    while (true) {
      const Vector z = solve(-q_);
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
      if (!first) return holds(i) ? Step::forward : Step::none;
      x_[held_[*first]] = 0;
      remove(held_[*first]);
      factorize();
    }
  }

 private:
  /// Of a column that those held give: along d, d_i = 1 and A d = 0, the value changes by d . q = w_i alone. So it
  /// falls until a component is 0; i takes its place.
  Step exchange(Eigen::Index i, Extended tolerance) {
    const Vector others = -solve(A_.col(i));
    // w_i = d . q, of which so much is rounding
    const Extended rounding = tolerance * (Extended(1) + (others.size() > 0 ? others.cwiseAbs().sum() : Extended(0)));
    if (q_[i] + A_.row(i).dot(x_) >= -rounding) return Step::none;
    std::optional<std::size_t> first;
    Extended way = 0;
    for (std::size_t k = 0; k < held_.size(); ++k) {
      const Extended part = others[static_cast<Eigen::Index>(k)];
      if (part >= -Extended(kNoPart)) continue;
      const Extended reach = x_[held_[k]] / -part;
      if (first && reach >= way) continue;
      way = reach;
      first = k;
    }
    if (!first) return Step::unbounded;
    for (std::size_t k = 0; k < held_.size(); ++k)
      x_[held_[k]] = std::max(Extended(0), x_[held_[k]] + way * others[static_cast<Eigen::Index>(k)]);
    x_[i] = way;
    x_[held_[*first]] = 0;
    remove(held_[*first]);
    add(i);
    return Step::forward;
  }

  void add(Eigen::Index i) { held_.insert(std::upper_bound(held_.begin(), held_.end(), i), i); }
  void remove(Eigen::Index i) { std::erase(held_, i); }

  /// False if one of the columns held is given by others.
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

  Vector solve(const Vector& whole) const {
    Vector right(static_cast<Eigen::Index>(held_.size()));
    for (std::size_t k = 0; k < held_.size(); ++k) right[static_cast<Eigen::Index>(k)] = whole[held_[k]];
    return held_.empty() ? right : Vector(factor_.solve(right));
  }

  const Matrix& A_;
  const Vector& q_;
  Vector x_;
  std::vector<Eigen::Index> held_;  // in order
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
  std::set<std::vector<Eigen::Index>> known{set.held()};
  while (true) {
    const Vector w = set.w();
    std::vector<Eigen::Index> order;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!set.holds(i) && w[i] < -tolerance * scale[i]) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return w[a] < w[b]; });
    bool goes_on = false;
    for (const Eigen::Index i : order) {
      const ActiveSet::Step step = set.take(i, tolerance * scale[i]);
      if (step == ActiveSet::Step::unbounded) return std::nullopt;
      if (step == ActiveSet::Step::none) continue;
      // each set has one value, and that falls: one that comes again is what rounding makes of the least
      goes_on = known.insert(set.held()).second;
      break;
    }
    if (!goes_on) return scale.cwiseProduct(set.x());
  }
}

}  // namespace trajet
