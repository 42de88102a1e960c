#include <pybind11/stl.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "columns.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/piece_index.hpp"
#include "trajet/sim/state_at.hpp"
#include "trajet/trajet.hpp"

namespace trajet::python {
namespace {

using Times = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Ends a run at Ctrl-C, and whatever else a handler of Python's signals raises.
class SignalWatch : public RunObserver {
 public:
  RunWishes wishes() const override { return {}; }

  bool interrupted(double) override {
    using std::chrono::steady_clock;
    // taking Python's lock costs a microsecond and more: a few times a second are enough for people
    constexpr auto kPause = std::chrono::milliseconds(30);
    if (!error_ && steady_clock::now() >= next_) {
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() != 0) error_.emplace();
      next_ = steady_clock::now() + kPause;
    }
    return error_.has_value();
  }

  /// Raises what a handler has raised, under Python's lock.
  void raise() {
    if (error_) throw py::error_already_set(*error_);
  }

 private:
  std::optional<py::error_already_set> error_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

/// Lets a comparison be interrupted.
class CompareWatch : public CompareObserver {
 public:
  explicit CompareWatch(SignalWatch& signals) : signals_(signals) {}
  RunObserver* begin_reference(const std::string&) override { return &signals_; }
  RunObserver* begin_row(const ComparisonRow&, std::size_t, std::size_t) override { return &signals_; }

 private:
  SignalWatch& signals_;
};

/// `compute(observer)` without Python's lock; raises what signals have asked for.
template <class Compute>
auto without_lock(const Compute& compute) {
  SignalWatch signals;
  auto result = [&] {
    const py::gil_scoped_release release;
    return compute(signals);
  }();
  signals.raise();
  return result;
}

Motion compute(const Scene& scene, const std::optional<std::vector<std::pair<std::string, long>>>& event_limits) {
  /// Ends a run when an event has happened so often.
  struct EventCount : RunObserver {
    RunWishes wishes() const override { return {}; }
    void event(const EventRecord& event) override {
      for (auto& [name, left] : *limits)
        if (name == event.event && --left == 0) is_over = true;
    }
    bool interrupted(double) override { return is_over; }
    std::vector<std::pair<std::string, long>>* limits = nullptr;
    bool is_over = false;
  };
  return without_lock([&](SignalWatch& signals) {
    std::vector<std::pair<std::string, long>> limits =
        event_limits.value_or(std::vector<std::pair<std::string, long>>());
    EventCount count;
    count.limits = &limits;
    ObserverList observers({&signals, &count});
    return compute_motion(scene, &observers);
  });
}

std::string compare_scene(const Scene& scene, const std::vector<std::string>& methods, const std::vector<long>& steps,
                          const std::vector<double>& rtols, const std::vector<std::string>& orientations,
                          const std::string& reference) {
  ComparePlan plan;
  plan.methods = methods;
  plan.step_counts = steps;
  for (const double rtol : rtols) plan.rtols.push_back(Expression::number(rtol, {"rtols"}));
  plan.orientations_where = {"orientations"};
  for (const std::string& name : orientations)
    plan.orientations.push_back(orientation_way(name, plan.orientations_where));
  plan.reference = reference;
  plan.methods_where = {"methods"};
  plan.reference_where = {"reference"};
  return compare_json(without_lock([&](SignalWatch& signals) {
    CompareWatch watch(signals);
    return compare(scene, plan, &watch);
  }));
}

std::string page(const std::vector<Motion>& motions, const std::string& scene_text) {
  std::vector<PageRun> runs;
  for (const Motion& motion : motions)
    runs.push_back({motion.record(), [&motion](const auto& write) { write_report_json(motion.result(), write); }});
  const py::gil_scoped_release release;
  return page_html(runs, {.scene_text = scene_text});
}

/// One of a body's questions at many times.  // (n x Rows)
template <int Rows>
using Question = void (BodyMotion::*)(std::span<const double>,
                                      Eigen::Ref<Eigen::Matrix<double, Rows, Eigen::Dynamic>>) const;
template <int Rows>
auto body_question(Question<Rows> question) {
  return [question](const Motion& motion, const std::string& body, const Times& times) {
    const BodyMotion asked = motion.body(body);
    py::array_t<double> answer({times.size(), py::ssize_t{Rows}});
    const std::span<const double> at(times.data(), static_cast<std::size_t>(times.size()));
    Eigen::Map<Eigen::Matrix<double, Rows, Eigen::Dynamic>> columns(answer.mutable_data(), Rows, times.size());
    const py::gil_scoped_release release;
    (asked.*question)(at, columns);
    return answer;
  };
}

py::array_t<double> value(const Motion& motion, const std::string& state, const Times& times) {
  const StateMotion asked = motion.extra_state(state);
  py::array_t<double> answer(times.size());
  Eigen::Map<Eigen::VectorXd> values(answer.mutable_data(), times.size());
  const py::gil_scoped_release release;
  asked.value({times.data(), static_cast<std::size_t>(times.size())}, values);
  return answer;
}

/// The ends of the steps of all groups, s since the start: the motion is smooth between two of them.
std::vector<double> joints(const Motion& motion) {
  std::vector<double> times;
  for (std::size_t group = 0; group < motion.world().groups.size(); ++group)
    for (const RecordedPiece& piece : motion.record().pieces(static_cast<int>(group)))
      times.insert(times.end(), {piece.from, piece.to});
  return times;
}

/// What an event's `when` is along the motion.
py::array_t<double> event_values(const Motion& motion, int event, const Times& times) {
  const World& world = motion.world();
  const World::Event& watched = world.events[static_cast<std::size_t>(event)];
  const std::vector<RecordedPiece>& pieces = motion.record().pieces(watched.group);
  py::array_t<double> answer(times.size());
  if (pieces.empty()) throw std::out_of_range("the motion has no duration");
  const PieceIndex index(pieces, world.direction());
  Evaluator<double> when(watched.when);
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    const double since = times.at(i) - world.epoch;
    const Eigen::VectorXd q = state_at(world, watched.group, pieces[index.find(since)].segment, since);
    when(since, q.data(), answer.mutable_data(i));
  }
  return answer;
}

void translate_errors(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const InputError& fault) {
    const py::object type = py::module_::import("trajet._errors").attr("SceneError");
    const SourceLocation& where = fault.where();
    PyErr_SetObject(type.ptr(), type(fault.message(), where.file.str(), where.line, where.column).ptr());
  } catch (const FileError& fault) {
    PyErr_SetString(PyExc_OSError, fault.what());
  } catch (const std::out_of_range& fault) {
    PyErr_SetString(PyExc_ValueError, fault.what());
  }
}

}  // namespace

void bind_motions(py::module_& module) {
  py::register_exception_translator(translate_errors);

  py::class_<Scene>(module, "Scene").def_readonly("title", &Scene::title);
  module.def("read_scene", &read_scene);
  module.def("parse_scene", &parse_scene);
  py::class_<SceneOverrides>(module, "Overrides")
      .def(py::init())
      .def_readwrite("parameters", &SceneOverrides::parameters)
      .def_readwrite("method", &SceneOverrides::method)
      .def_readwrite("step", &SceneOverrides::step)
      .def_readwrite("order", &SceneOverrides::order)
      .def_readwrite("rtol", &SceneOverrides::rtol)
      .def_readwrite("atol", &SceneOverrides::atol)
      .def_readwrite("end", &SceneOverrides::end)
      .def_readwrite("orientation", &SceneOverrides::orientation);
  module.def("apply", [](const SceneOverrides& overrides, Scene& scene) { apply(overrides, scene); });
  module.def("check", [](const Scene& scene) { return make_world(scene).warnings; });
  module.def("compute_motion", &compute, py::arg("scene"), py::arg("event_limits") = py::none());
  module.def("compare", &compare_scene);
  module.def("page", &page);
  module.attr("version") = kVersion;

  py::class_<Motion>(module, "Motion")
      .def_property_readonly("status", [](const Motion& m) { return std::string(name(m.status())); })
      .def_property_readonly("ok", &Motion::ok)
      .def_property_readonly("failure", [](const Motion& m) { return m.result().failure; })
      .def_property_readonly("title", [](const Motion& m) { return m.result().title; })
      .def_property_readonly("method", [](const Motion& m) { return m.result().method; })
      .def_property_readonly("start_time", &Motion::start_time)
      .def_property_readonly("end_time", &Motion::end_time)
      .def_property_readonly("warnings", &Motion::warnings)
      .def_property_readonly("parameters", [](const Motion& m) { return named(m.result().parameters); })
      .def_property_readonly("states", [](const Motion& m) { return named(m.final().states); })
      .def_property_readonly(
          "bodies",
          [](const Motion& m) { return texts(m.world().bodies, [](const World::Body& b) { return b.name; }); })
      .def_property_readonly("statistics",
                             [](const Motion& m) {
                               const RunStatistics& s = m.result().statistics;
                               py::dict table;
                               table["steps"] = s.steps;
                               table["rejected_steps"] = s.rejected_steps;
                               table["law_evaluations"] = s.law_evaluations;
                               table["contact_searches"] = s.contact_searches;
                               table["wall_seconds"] = s.wall_seconds;
                               return table;
                             })
      .def("impact_columns", &impact_columns)
      .def("event_columns", &event_columns)
      .def("contact_columns", &contact_columns)
      .def("final_columns", [](const Motion& m) { return body_columns(m.final().bodies); })
      .def("state_columns", [](const Motion& m, double t) { return body_columns(m.state(t).bodies); })
      .def("position", body_question<3>(&BodyMotion::position))
      .def("velocity", body_question<3>(&BodyMotion::velocity))
      .def("orientation", body_question<4>(&BodyMotion::orientation))
      .def("angular_velocity", body_question<3>(&BodyMotion::angular_velocity))
      .def("value", &value)
      .def("joints", &joints)
      .def("event_values", &event_values)
      .def("report", [](const Motion& m) { return report_json(m.result()); })
      .def("text", [](const Motion& m) { return to_string(m); });
}

}  // namespace trajet::python
