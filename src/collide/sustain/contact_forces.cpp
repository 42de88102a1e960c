#include "trajet/collide/sustain/contact_forces.hpp"

#include <cmath>

namespace trajet {

std::vector<ContactRates> rates_by(const BodyTerms<double>& terms, const std::vector<ContactForce<double>>& forces) {
  Vector3 acceleration = Vector3::Zero(), moment = Vector3::Zero();
  for (const ContactForce<double>& each : forces) {
    acceleration += terms.inverse_mass * each.force;
    moment += each.moment;
  }
  const Vector3 turning = terms.inverse_inertia * moment;
  std::vector<ContactRates> rates;
  for (const ContactTerms<double>& at : terms.points) rates.push_back({acceleration + turning.cross(at.arm), turning});
  return rates;
}

std::vector<ContactUnknown> contact_unknowns(const std::vector<ContactPoints>& contacts,
                                             const std::vector<ContactMode>& modes) {
  using Kind = ContactUnknown::Kind;
  std::vector<ContactUnknown> unknowns;
  for (int c = 0; c < static_cast<int>(modes.size()); ++c) {
    const ContactMode& mode = modes[static_cast<std::size_t>(c)];
    const auto add = [&](Kind kind, int count) {
      for (int i = 0; i < count; ++i) unknowns.push_back({c, kind, i});
    };
    const ContactPoints& contact = contacts[static_cast<std::size_t>(c)];
    if (!contact.is_one()) {
      add(Kind::normal, static_cast<int>(contact.shares.rows()));
      if (const int sticking = mode.sticking_point(); sticking >= 0)
        for (int axis = 0; axis < 2; ++axis) unknowns.push_back({c, Kind::hold, axis, sticking});
      if (!mode.slip.is_held()) continue;
      add(Kind::hold, 2);
      add(Kind::spin, 1);
      continue;
    }
    mode.slip.is_held() ? add(Kind::force, 3) : add(Kind::normal, 1);
    if (mode.roll.is_held() && mode.spin.is_held()) {
      add(Kind::turn, 3);
    } else if (mode.roll.is_held()) {
      add(Kind::tangent, 2);
    } else if (mode.spin.is_held()) {
      add(Kind::spin, 1);
    }
  }
  return unknowns;
}

std::vector<ContactUnknown> independent_unknowns(const BodyTerms<double>& terms, const std::vector<ContactMode>& modes,
                                                 const std::vector<FrictionCoefficients>& friction) {
  const detail::ContactSystem<double> system(terms, modes, friction);
  std::vector<ContactUnknown> left = contact_unknowns(terms.contacts, modes), kept;
  const auto n = static_cast<Eigen::Index>(left.size());
  Eigen::MatrixXd a(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto& x = left[static_cast<std::size_t>(j)];
    const auto wrench = system.wrench(x);
    for (Eigen::Index i = 0; i < n; ++i) a(i, j) = system.response(left[static_cast<std::size_t>(i)], wrench);
  }
  // Gaussian elimination with pivots on the diagonal; what is left of a dependent one is rounding
  constexpr double kDependent = 1e-9;
  const Eigen::VectorXd scale = a.diagonal().cwiseAbs();
  std::vector<bool> is_done(left.size(), false);
  for (Eigen::Index step = 0; step < n; ++step) {
    Eigen::Index best = -1;
    double share = kDependent;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double part = scale[i] > 0.0 ? std::abs(a(i, i)) / scale[i] : 0.0;
      if (!is_done[static_cast<std::size_t>(i)] && part > share) {
        best = i;
        share = part;
      }
    }
    if (best < 0) break;
    is_done[static_cast<std::size_t>(best)] = true;
    kept.push_back(left[static_cast<std::size_t>(best)]);
    kept.back().order = static_cast<int>(step);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_done[static_cast<std::size_t>(i)]) continue;
      const double factor = a(i, best) / a(best, best);
      a.row(i) -= factor * a.row(best);
    }
  }
  return kept;
}

}  // namespace trajet
