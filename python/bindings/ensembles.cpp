#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "trajet/ensemble/aim.hpp"
#include "trajet/ensemble/sweep.hpp"
#include "trajet/io/aim_json.hpp"
#include "trajet/io/sweep_plan_text.hpp"
#include "trajet/io/variation_text.hpp"
#include "trajet/sim/names.hpp"

namespace trajet::python {
namespace {

/// Whether a handler of Python's signals has raised something. Asked by the thread that Python called, now and then;
/// other threads hear of it.
class SignalFlag {
 public:
  bool operator()() {
    using std::chrono::steady_clock;
    constexpr auto kPause = std::chrono::milliseconds(30);
    if (is_raised_) return true;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || steady_clock::now() < next_) return is_raised_;
    const py::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) {
      error_.emplace();
      is_raised_ = true;
    }
    next_ = steady_clock::now() + kPause;
    return is_raised_;
  }
  /// Raises it, under Python's lock.
  void raise() {
    if (error_) throw py::error_already_set(*error_);
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> is_raised_{false};
  std::optional<py::error_already_set> error_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

/// A column of a sweep as it grows.
struct Column {
  std::string name;
  bool is_word = false;
  std::vector<double> numbers{};
  std::vector<std::string> words{};

  void add(const Cell& cell) {
    if (is_word) {
      const auto* word = std::get_if<std::string>(&cell);
      words.push_back(word == nullptr ? "" : *word);
    } else {
      const auto* number = std::get_if<double>(&cell);
      numbers.push_back(number == nullptr ? std::numeric_limits<double>::quiet_NaN() : *number);
    }
  }
  py::object array() const {
    if (is_word) return py::cast(words);
    return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
  }
};

/// Columns by name: the varied quantities, the reported expressions, `status` where motions failed.
py::dict sweep(Scene scene, const SweepPlanTexts& texts, const std::vector<std::string>& report, int threads) {
  SweepPlan plan = read_sweep_plan(texts, scene);
  const std::uint64_t count = plan.count();
  const Sweep sweep(std::move(scene), std::move(plan), report, {"--report"});
  std::vector<Column> columns;
  const std::size_t quantities = sweep.plan().quantity_count();
  for (std::size_t i = 0; i < quantities; ++i) columns.push_back({sweep.plan().quantity(i).name});
  const std::vector<std::string>& expressions = sweep.columns().texts();
  for (std::size_t i = 0; i < expressions.size(); ++i) columns.push_back({expressions[i], sweep.columns().is_word(i)});
  std::vector<std::string> failures;
  SignalFlag signals;
  {
    const py::gil_scoped_release release;
    run_sweep(
        sweep, {.last = count, .threads = threads},
        [&](SweepBlock&& block) {
          for (const SweepRow& row : block.rows) {
            for (std::size_t i = 0; i < quantities; ++i) columns[i].add(row.values[i]);
            for (std::size_t i = 0; i < expressions.size(); ++i) columns[quantities + i].add(row.cells[i]);
            failures.push_back(row.failure);
          }
          return true;
        },
        [&] { return signals(); });
  }
  signals.raise();
  py::dict table, result;
  for (const Column& column : columns) table[py::str(column.name)] = column.array();
  result["columns"] = std::move(table);
  result["failures"] = failures;
  result["warnings"] = sweep.scene().warnings;
  return result;
}

std::string aim_at(Scene scene, const std::vector<std::string>& vary, const std::string& hit, const std::string& at,
                   const std::string& body, const std::vector<std::string>& conditions, const std::string& minimise) {
  AimTask task{.scene = std::move(scene), .body = body, .conditions = conditions, .minimise = minimise};
  for (const std::string& text : vary) {
    GridAxis axis = read_range(text, "--vary", task.scene);
    task.unknowns.push_back({std::move(axis.quantity), axis.low, axis.high});
  }
  if (hit.empty())
    task.target = read_point(at, "--at", task.scene);
  else
    task.target = hit;
  SignalFlag signals;
  const std::string json = [&] {
    const py::gil_scoped_release release;
    return aim_json(task, aim(task, [&] { return signals(); }));
  }();
  signals.raise();
  return json;
}

}  // namespace

void bind_ensembles(py::module_& module) {
  py::class_<SweepPlanTexts>(module, "SweepPlan")
      .def(py::init())
      .def_readwrite("vary", &SweepPlanTexts::vary)
      .def_readwrite("sample", &SweepPlanTexts::sample)
      .def_readwrite("correlate", &SweepPlanTexts::correlate)
      .def_readwrite("count", &SweepPlanTexts::count)
      .def_readwrite("seed", &SweepPlanTexts::seed)
      .def_readwrite("design", &SweepPlanTexts::design);
  module.def("sweep", &sweep);
  module.def("aim", &aim_at);
}

}  // namespace trajet::python
