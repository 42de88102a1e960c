#include "trajet/collide/respond/restitution_law.hpp"

#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_jacobian.hpp"

namespace trajet {

double RestitutionLaw::at(double u) const {
  if (!of_speed_) return constant_;
  double value = 0.0;
  Evaluator<double> evaluate(*of_speed_);
  evaluate(0.0, &u, &value);
  return value;
}

double RestitutionLaw::change_rate(double u) const {
  double by_speed = 0.0, by_time = 0.0;
  if (of_speed_) {
    ProgramJacobian jacobian(*of_speed_);
    jacobian(0.0, &u, &by_speed, &by_time);
  }
  return 1.0 + at(u) + by_speed * u;
}

}  // namespace trajet
