#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "trajet/sim/motion.hpp"
#include "trajet/sim/names.hpp"

/// What a report has, as columns by name: arrays of numbers, lists of texts. The package makes structured arrays of
/// them.
namespace trajet::python {

/// Numbers as columns of a table. `part(item)` has `Width` numbers; a column of one has one dimension.
template <class Items, class Part>
py::array_t<double> column(const Items& items, int width, const Part& part) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(items.size())};
  if (width > 1) shape.push_back(width);
  py::array_t<double> values(shape);
  double* next = values.mutable_data();
  for (const auto& item : items) {
    const auto numbers = part(item);
    for (int i = 0; i < width; ++i) *next++ = numbers[i];
  }
  return values;
}

/// Texts likewise.
template <class Items, class Part>
py::list texts(const Items& items, const Part& part) {
  py::list values;
  for (const auto& item : items) values.append(std::string(part(item)));
  return values;
}

// What `column` takes a number for, a quaternion, and a vector that there is none of.
inline Eigen::Vector<double, 1> one(double value) { return Eigen::Vector<double, 1>(value); }
inline Eigen::Vector4d numbers(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline Eigen::Vector3d none() { return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

inline py::dict impact_columns(const Motion& motion) {
  const auto& all = motion.impacts();
  using I = const Impact&;
  py::dict table;
  table["time"] = column(all, 1, [](I i) { return one(i.time); });
  table["body"] = texts(all, [](I i) { return i.body; });
  table["with"] = texts(all, [](I i) { return i.with; });
  table["kind"] = texts(all, [](I i) { return trajet::name(i.kind); });
  table["point"] = column(all, 3, [](I i) { return i.point; });
  table["normal"] = column(all, 3, [](I i) { return i.normal; });
  table["position"] = column(all, 3, [](I i) { return i.position; });
  table["velocity_before"] = column(all, 3, [](I i) { return i.velocity_before; });
  table["velocity_after"] = column(all, 3, [](I i) { return i.velocity_after; });
  table["angular_velocity_before"] = column(all, 3, [](I i) { return i.angular_velocity_before; });
  table["angular_velocity_after"] = column(all, 3, [](I i) { return i.angular_velocity_after; });
  table["impulse"] = column(all, 3, [](I i) { return i.impulse; });
  table["time_error_bound"] = column(all, 1, [](I i) { return one(i.time_error_bound); });
  const auto of_partner = [&](Vector3 ImpactPartner::*member) {
    return column(all, 3, [member](I i) { return i.partner ? Eigen::Vector3d((*i.partner).*member) : none(); });
  };
  table["with_velocity_before"] = of_partner(&ImpactPartner::velocity_before);
  table["with_velocity_after"] = of_partner(&ImpactPartner::velocity_after);
  table["with_angular_velocity_before"] = of_partner(&ImpactPartner::angular_velocity_before);
  table["with_angular_velocity_after"] = of_partner(&ImpactPartner::angular_velocity_after);
  table["group"] =
      column(all, 1, [](I i) { return one(i.group ? *i.group : std::numeric_limits<double>::quiet_NaN()); });
  table["features"] = texts(all, [](I i) {
    return i.touched
               ? std::string(trajet::name(i.touched->of_body)) + " " + std::string(trajet::name(i.touched->of_obstacle))
               : std::string();
  });
  return table;
}

inline py::dict event_columns(const Motion& motion) {
  const auto& all = motion.events();
  using E = const EventRecord&;
  py::dict table;
  table["time"] = column(all, 1, [](E e) { return one(e.time); });
  table["event"] = texts(all, [](E e) { return e.event; });
  table["direction"] = texts(all, [](E e) { return e.direction < 0 ? "falling" : "rising"; });
  table["law"] = texts(all, [](E e) { return e.law; });
  return table;
}

inline py::dict contact_columns(const Motion& motion) {
  const auto& all = motion.contacts();
  using C = const ContactSpan&;
  py::dict table;
  table["from"] = column(all, 1, [](C c) { return one(c.from); });
  table["to"] = column(all, 1, [](C c) { return one(c.to.value_or(std::numeric_limits<double>::quiet_NaN())); });
  table["body"] = texts(all, [](C c) { return c.body; });
  table["with"] = texts(all, [](C c) { return c.with; });
  table["mode"] = texts(all, [](C c) { return trajet::name(c.mode); });
  return table;
}

inline py::dict body_columns(const std::vector<BodyState>& all) {
  using B = const BodyState&;
  py::dict table;
  table["body"] = texts(all, [](B b) { return b.body; });
  table["position"] = column(all, 3, [](B b) { return b.position; });
  table["velocity"] = column(all, 3, [](B b) { return b.velocity; });
  table["acceleration"] = column(all, 3, [](B b) { return b.acceleration; });
  table["orientation"] = column(all, 4, [](B b) { return numbers(b.orientation); });
  table["rotation_matrix"] = column(all, 9, [](B b) {
    return Eigen::Vector<double, 9>(Matrix3(b.rotation_matrix.transpose()).reshaped());  // row by row
  });
  table["angular_velocity"] = column(all, 3, [](B b) { return b.angular_velocity; });
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  table["position_error_bound"] = column(all, 1, [=](B b) { return one(b.position_error_bound.value_or(unknown)); });
  table["velocity_error_bound"] = column(all, 1, [=](B b) { return one(b.velocity_error_bound.value_or(unknown)); });
  return table;
}

inline py::dict named(const std::vector<NamedValue>& values) {
  py::dict table;
  for (const NamedValue& each : values) table[py::str(each.name)] = each.value;
  return table;
}

}  // namespace trajet::python
