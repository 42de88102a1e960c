#include "trajet/collide/respond/restitution_law.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_jacobian.hpp"

namespace trajet {

RestitutionLaw RestitutionLaw::mean(const RestitutionLaw& a, const RestitutionLaw& b) {
  const auto is_number = [](const RestitutionLaw& law) { return !law.of_speed_ && !law.factors_; };
  if (is_number(a) && is_number(b)) return a.constant_ == b.constant_ ? a : std::sqrt(a.constant_ * b.constant_);
  RestitutionLaw law;
  law.factors_ = std::make_shared<const std::pair<RestitutionLaw, RestitutionLaw>>(a, b);
  return law;
}

double RestitutionLaw::at(double u) const {
  if (factors_) {
    const double a = factors_->first.at(u), b = factors_->second.at(u);
    // neither may be negative, though their product is not
    return a < 0.0 || b < 0.0 ? std::min(a, b) : std::sqrt(a * b);
  }
  if (!of_speed_) return constant_;
  double value = 0.0;
  Evaluator<double> evaluate(*of_speed_);
  evaluate(0.0, &u, &value);
  return value;
}

double RestitutionLaw::slope(double u) const {
  if (factors_) {
    const auto& [a, b] = *factors_;
    const double mean = at(u);
    return mean > 0.0 ? (a.slope(u) * b.at(u) + a.at(u) * b.slope(u)) / (2.0 * mean) : 0.0;
  }
  double by_speed = 0.0, by_time = 0.0;
  if (of_speed_) {
    ProgramJacobian jacobian(*of_speed_);
    jacobian(0.0, &u, &by_speed, &by_time);
  }
  return by_speed;
}

double RestitutionLaw::change_rate(double u) const { return 1.0 + at(u) + slope(u) * u; }

}  // namespace trajet
