// The error bound of polynomials on a window, against the same sums and products in extended precision: it holds, and
// is not a hundred times too large.

#include "trajet/math/window_polynomial.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "trajet/portable.hpp"
#include "trajet/rigid/frame_path.hpp"

namespace trajet {
namespace {

using Exact = std::vector<Extended>;  // coefficients, of any degree

Exact product(const Exact& a, const Exact& b) {
  Exact c(a.size() + b.size() - 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}
void add(Exact& a, Extended s, const Exact& b) {
  a.resize(std::max(a.size(), b.size()), 0);
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += s * b[i];
}
Extended value(const Exact& a, Extended u) {
  Extended sum = 0;
  for (std::size_t k = a.size(); k-- > 0;) sum = sum * u + a[k];
  return sum;
}
Extended value(const WindowPolynomial& p, Extended u) {
  Extended sum = 0;
  for (int k = p.degree(); k >= 0; --k) sum = sum * u + Extended(p.coefficients()[k]);
  return sum;
}

/// The largest distance on [-1, 1].
double distance(const WindowPolynomial& p, const Exact& exact) {
  Extended most = 0;
  for (int i = -50; i <= 50; ++i) {
    const Extended u = Extended(i) / 50;
    most = std::max(most, std::abs(value(p, u) - value(exact, u)));
  }
  return static_cast<double>(most);
}

struct Both {
  WindowPolynomial window{};
  Exact exact{};
};

class RandomPolynomials {
 public:
  explicit RandomPolynomials(unsigned seed) : random_(seed) {}
  /// Coefficients that fall off like those of a turn by `angle`.
  Both polynomial(int degree, double angle) {
    std::normal_distribution<double> normal;
    WindowPolynomial::Coefficients c = WindowPolynomial::Coefficients::Zero();
    Exact exact;
    double size = 1.0;
    for (int k = 0; k <= degree; ++k) {
      c[k] = size * normal(random_);
      exact.push_back(c[k]);
      size *= angle / (k + 1);
    }
    return {{c, degree, 0.0, 0.0}, exact};
  }

 private:
  std::mt19937 random_;
};

TEST(WindowPolynomial, TheBoundOfSumsOfProductsHoldsAndIsNotTooLarge) {
  for (const double angle : {0.0, 0.2, 0.75, 1.5}) {
    double worst = 0.0;
    RandomPolynomials random(3);
    for (int k = 0; k < 300; ++k) {
      ProductSum sum;
      Exact exact{0};
      for (int i = 0; i < 3; ++i) {
        const Both a = random.polynomial(12, angle), b = random.polynomial(12, angle);
        sum.add(a.window, b.window, i == 1 ? -1.0 : 1.0);
        add(exact, i == 1 ? -1 : 1, product(a.exact, b.exact));
      }
      const WindowPolynomial once = sum.value();
      EXPECT_LE(distance(once, exact), once.error());
      // and a product of that, as a separation is
      const Both c = random.polynomial(12, angle);
      const WindowPolynomial twice = once * c.window;
      const double error = distance(twice, product(exact, c.exact));
      EXPECT_LE(error, twice.error());
      EXPECT_LE(twice.cut(), twice.error());
      worst = std::max(worst, error / twice.error());
    }
    EXPECT_GT(worst, 0.01) << angle;
  }
}

TEST(WindowPolynomial, TheBoundOfLinearSumsHolds) {
  RandomPolynomials random(5);
  double worst = 0.0;
  for (int k = 0; k < 300; ++k) {
    LinearSum sum;
    Exact exact{0};
    for (int i = 0; i < 4; ++i) {
      const Both a = random.polynomial(15, 1.0);
      const double s = 0.1 + i / 3.0;
      sum.add(s, a.window);
      add(exact, s, a.exact);
    }
    const WindowPolynomial p = sum.value();
    const double error = distance(p, exact);
    EXPECT_LE(error, p.error());
    worst = std::max(worst, error / p.error());
  }
  EXPECT_GT(worst, 0.05);
}

/// The frame of a path on a window anywhere in it, before its begin and behind its end too.
TEST(WindowPolynomial, TheBoundOfAPathOnAWindowHolds) {
  double worst = 0.0;
  for (int k = 0; k < 200; ++k) {
    std::mt19937 random(static_cast<unsigned>(k));
    std::normal_distribution<double> normal;
    FramePath::Coefficients c(7, 22);
    double size = 1.0;
    for (int i = 0; i < 22; ++i) {
      for (int j = 0; j < 7; ++j) c(j, i) = size * normal(random);
      size *= 3.0 / (i + 1);
    }
    const FramePath path(10.0, 11.0, c);
    // in the longest one what is cut off is most of the bound
    const double half = k % 3 == 0 ? 0.11 : k % 3 == 1 ? -0.2 : 0.9, middle = 10.0 + 0.005 * k;
    const FrameWindow window(path, middle, half);
    for (int i = 0; i <= 20; ++i) {
      const Extended u = Extended(i - 10) / 10, tau = Extended(middle) - Extended(path.t0()) + Extended(half) * u;
      Extended x[7];
      for (int j = 0; j < 7; ++j) {
        x[j] = 0;
        for (Eigen::Index l = 22; l-- > 0;) x[j] = x[j] * tau + Extended(c(j, l));
      }
      const Extended D = x[3] * x[3] + x[4] * x[4] + x[5] * x[5] + x[6] * x[6];
      const Extended N01 = 2 * (x[4] * x[5] - x[3] * x[6]), N22 = x[3] * x[3] - x[4] * x[4] - x[5] * x[5] + x[6] * x[6];
      const auto look = [&](const WindowPolynomial& p, Extended exact) {
        const auto error = static_cast<double>(std::abs(value(p, u) - exact));
        EXPECT_LE(error, p.error());
        worst = std::max(worst, error / p.error());
      };
      look(window.p[1], x[1]);
      look(window.D, D);
      look(window.N[0][1], N01);
      look(window.N[2][2], N22);
    }
  }
  EXPECT_GT(worst, 0.01);
}

}  // namespace
}  // namespace trajet
