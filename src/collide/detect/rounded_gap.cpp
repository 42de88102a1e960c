#include "rounded_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trajet::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Encloses |v| and its first two derivatives on a piece, by control vectors.
RoundedGap::Piece enclose_length(const WindowVector& v, double from, double to) {
  const int count = std::max({v[0].degree(), v[1].degree(), v[2].degree()}) + 1;
  const std::array<BernsteinForm, 3> form{BernsteinForm(v[0].span(count), from, to),
                                          BernsteinForm(v[1].span(count), from, to),
                                          BernsteinForm(v[2].span(count), from, to)};
  std::array<Vector3, WindowPolynomial::kSize> control;
  Vector3 middle = Vector3::Zero();
  double longest = 0.0;
  for (int k = 0; k < count; ++k) {
    Vector3& c = control[static_cast<std::size_t>(k)];
    c = {form[0].coefficient(k), form[1].coefficient(k), form[2].coefficient(k)};
    middle += c;
    longest = std::max(longest, c.norm());
  }
  const double error = form[0].error() + form[1].error() + form[2].error() + 8.0 * kUnitRoundoff * longest;
  const Vector3 direction = middle.norm() > 0.0 ? Vector3(middle.normalized()) : Vector3(Vector3::Zero());

  // v / |v| is `direction` but for `aside`, |aside| <= 2 sin(half the angle of the cone that holds all v)
  double shortest = kInfinity;
  double cosine = 1.0;
  for (int k = 0; k < count; ++k) {
    const Vector3& c = control[static_cast<std::size_t>(k)];
    const double along = direction.dot(c);
    shortest = std::min(shortest, along);
    cosine = std::min(cosine, (along - error) / (c.norm() + error));
  }
  shortest = std::max(0.0, shortest - error);
  const double aside = shortest > 0.0 ? std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine)) + 1e-15 : 2.0;

  RoundedGap::Piece length;
  length.value = {shortest, longest + error};
  const double n = count - 1.0;
  Range first{0.0, 0.0}, second{0.0, 0.0};
  double most_first = 0.0, most_second = 0.0;
  for (int k = 0; k + 1 < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    const Vector3 d = n * (control[i + 1] - control[i]);
    const double along = direction.dot(d);
    first = k == 0 ? Range{along, along} : Range{std::min(first.lower, along), std::max(first.upper, along)};
    most_first = std::max(most_first, d.norm());
    if (k + 2 >= count) continue;
    const Vector3 e = n * (n - 1.0) * ((control[i + 2] - control[i + 1]) - (control[i + 1] - control[i]));
    const double across = direction.dot(e);
    second = k == 0 ? Range{across, across} : Range{std::min(second.lower, across), std::max(second.upper, across)};
    most_second = std::max(most_second, e.norm());
  }
  const double first_error = 2.0 * n * error + aside * (most_first + 2.0 * n * error);
  const double second_error = 4.0 * n * n * error + aside * (most_second + 4.0 * n * n * error);
  length.rate = {first.lower - first_error, first.upper + first_error};
  // |v|'' = v'' . v / |v| + (the part of v' across v)^2 / |v|
  const double bend = most_first + 2.0 * n * error;
  length.curvature = {second.lower - second_error,
                      second.upper + second_error + (shortest > 0.0 ? bend * bend / shortest : kInfinity)};
  return length;
}

void subtract(Range& from, const Range& what) {
  from.lower -= what.upper;
  from.upper -= what.lower;
}

}  // namespace

RoundedGap::Piece RoundedGap::piece(double from, double to) const {
  const BernsteinForm form(s_->span(), from, to);
  Piece piece{form.value_range(), form.first_difference_range(), form.second_difference_range()};
  for (std::size_t m = 0; m < count_; ++m) {
    const Piece length = enclose_length(*lengths_[m], from, to);
    subtract(piece.value, length.value);
    subtract(piece.rate, length.rate);
    subtract(piece.curvature, length.curvature);
  }
  return piece;
}

FunctionSample RoundedGap::at(double u) const {
  const MeasuredJet s = evaluate_polynomial(s_->span(), u);
  Jet g = s.jet;
  double magnitude = s.magnitude;
  int degree = s_->degree();
  for (std::size_t m = 0; m < count_; ++m) {
    Vector3 v, dv, ddv;
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
      const MeasuredJet x = evaluate_polynomial((*lengths_[m])[static_cast<std::size_t>(i)].span(), u);
      v[i] = x.jet.value, dv[i] = x.jet.rate, ddv[i] = x.jet.curvature;
      size += x.magnitude;
      degree = std::max(degree, (*lengths_[m])[static_cast<std::size_t>(i)].degree());
    }
    const double length = v.norm();
    magnitude += size;
    g.value -= length;
    if (!(length > 0.0)) continue;
    const double rate = v.dot(dv) / length;
    g.rate -= rate;
    g.curvature -= (v.dot(ddv) + dv.squaredNorm() - rate * rate) / length;
  }
  const double size = kUnitRoundoff * magnitude;
  return {g, (2.0 * degree + 4.0) * size,
          std::max(3.0 * (BernsteinForm::roundings(degree) + 8.0) * size, touch_tolerance_)};
}

}  // namespace trajet::detail
