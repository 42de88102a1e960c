#pragma once

#include <array>
#include <cstddef>

namespace trajet {

/// The coefficients of a Rosenbrock method with `Stages` stages and a dense output of degree `Degree`, in the form of
/// [HairerWanner1996] IV.7 (7.25) that needs no product with the Jacobian J = dg/dq(t0, q0):
///
///     (I - h gamma J) u_i = h gamma (g(t0 + alpha_i h, q0 + sum_{j<i} a_ij u_j) + sum_{j<i} c_ij u_j / h + h gamma_i
///     dg/dt) q1     = q0 + sum_i m_i u_i q(s h) = q0 + sum_i (sum_{j=1..Degree} dense_ij s^j) u_i,  0 <= s <= 1 error
///     = q1 - companion = sum_i e_i u_i
template <int Stages, int Degree>
struct RosenbrockTableau {
  static constexpr int kStages = Stages;
  static constexpr int kDegree = Degree;
  template <int Columns>
  using Rows = std::array<std::array<double, Columns>, Stages>;

  double gamma;
  std::array<double, Stages> alpha;
  std::array<double, Stages> gamma_sum;
  Rows<Stages> a;
  Rows<Stages> c;
  std::array<double, Stages> m;
  std::array<double, Stages> e;
  Rows<Degree> dense;
};

/// Shampine and Reichelt's pair of orders 2 and 3, MATLAB's ode23s: [ShampineReichelt1997] §3.2. Their k_i are
///
///     W k1 = g0 + h d T,  W (k2 - k1) = g(h/2, h/2 k1) - k1,
///     W k3 = g(h, h k2) - e32 (k2 - g(h/2)) - 2 (k1 - g0) + h d T,   W = I - h d J, T = dg/dt
///
/// with d = 1/(2 + sqrt 2), e32 = 6 + sqrt 2; here u1 = h d k1, u2 = h d (k2 - k1), u3 = h d (k3 - e32 (k2 - k1) - 2
/// k1). q1 = q0 + h k2, companion q0 + h/6 (k1 + 4 k2 + k3), and q(s h) = q0 + h (s k1 + s (s - 2 d)/(1 - 2 d) (k2 -
/// k1)).
struct Rosenbrock23Tableau {
  static constexpr int kOrder = 2;
  static constexpr int kErrorPower = 3;
  static constexpr int kDenseOrder = 2;
  /// Whether the last stage's rate is that at the end of the step.
  static constexpr bool kLastStageIsEnd = true;

  static constexpr double kSqrt2 = 1.4142135623730951;
  static constexpr double kD = 1.0 - 0.5 * kSqrt2;
  static constexpr double kE32 = 6.0 + kSqrt2;
  static constexpr RosenbrockTableau<3, 2> kTableau = {
      .gamma = kD,
      .alpha = {0.0, 0.5, 1.0},
      .gamma_sum = {kD, 0.0, -kD},
      .a = {{{}, {0.5 / kD}, {1.0 / kD, 1.0 / kD}}},
      .c = {{{}, {-1.0 / kD}, {-2.0 / kD, -kE32 / kD}}},
      .m = {1.0 / kD, 1.0 / kD, 0.0},
      .e = {-1.0 / (6.0 * kD), (2.0 - kE32) / (6.0 * kD), -1.0 / (6.0 * kD)},
      .dense = {{{1.0 / kD, 0.0}, {-2.0 / (1.0 - 2.0 * kD), 1.0 / (kD * (1.0 - 2.0 * kD))}, {}}},
  };
};

namespace detail {

/// By powers of s, the weights of u_i in q(s h) = (1 - s) q0 + s (q1 + (1 - s) sum_i (h_1i + s h_2i + s^2 h_3i) u_i).
template <std::size_t Stages>
constexpr std::array<std::array<double, 4>, Stages> steinebach_dense(
    const std::array<double, Stages>& m, const std::array<std::array<double, Stages>, 3>& h) {
  std::array<std::array<double, 4>, Stages> powers{};
  for (std::size_t i = 0; i < Stages; ++i) powers[i] = {m[i] + h[0][i], h[1][i] - h[0][i], h[2][i] - h[1][i], -h[2][i]};
  return powers;
}

}  // namespace detail

/// Steinebach's method of order 5 with eight stages, stiffly accurate, with an A-stable companion of order 4 and a
/// dense output of order 4: [Steinebach2023].
struct Rodas5pTableau {
  static constexpr int kOrder = 5;
  static constexpr int kErrorPower = 5;
  static constexpr int kDenseOrder = 4;
  static constexpr bool kLastStageIsEnd = false;

 private:
  using Row = std::array<double, 8>;
  static constexpr Row kLastA = {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256,
                                 0.030198172008377946};
  static constexpr Row kM = {kLastA[0], kLastA[1], kLastA[2], kLastA[3], kLastA[4], 1.0, 1.0, 1.0};
  static constexpr std::array<Row, 3> kH = {{
      {25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, 0.524948541321073,
       1.1241088310450404, 0.4272876194431874, -0.17202221070155493},
      {-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796, 20.176138334709044,
       15.98066361424651, -6.789040303419874, -6.710236069923372},
      {11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643, -52.072871366152654,
       -59.78993625266729, -0.15582684282751913, 4.883087185713722},
  }};

 public:
  static constexpr RosenbrockTableau<8, 4> kTableau = {
      .gamma = 0.21193756319429014,
      .alpha = {0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716, 0.4288403609558664, 1.0, 1.0, 1.0},
      .gamma_sum = {0.21193756319429014, -0.42387512638858027, -0.3384627126235924, 1.8046452872882734,
                    2.325825639765069, 0.0, 0.0, 0.0},
      .a = {{{},
             {3.0},
             {2.849394379747939, 0.45842242204463923},
             {-6.954028509809101, 2.489845061869568, -10.358996098473584},
             {2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641},
             kLastA,
             {kLastA[0], kLastA[1], kLastA[2], kLastA[3], kLastA[4], 1.0},
             {kLastA[0], kLastA[1], kLastA[2], kLastA[3], kLastA[4], 1.0, 1.0}}},
      .c = {{{},
             {-14.155112264123755},
             {-17.97296035885952, -2.859693295451294},
             {147.12150275711716, -1.41221402718213, 71.68940251302358},
             {165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306},
             {24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471},
             {30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783, -19.097331116725623,
              -28.087943162872662},
             {37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047, -40.06618937091002,
              -54.66780262877968, -9.48861652309627}}},
      .m = kM,
      .e = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0},
      .dense = detail::steinebach_dense(kM, kH),
  };
};

}  // namespace trajet
