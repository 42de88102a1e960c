#include "aim_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace trajet {
namespace {

/// How the ranges of so many unknowns are searched. Numbers of cells are powers of two, so that places are exact.
struct Grid {
  int cells;               // at first, along each unknown
  int deepest;             // a cell is halved at most so often
  int deepest_at_borders;  // where a label ends in the cell
  long most_motions;
};
constexpr std::array<Grid, 4> kGrids{{{64, 26, 14, 20'000}, {16, 12, 3, 10'000}, {8, 6, 1, 20'000}, {4, 4, 1, 20'000}}};
constexpr int kDeepestOfFamily = 2;

/// What the deviation from a linear model is taken to be at least, of the changes in the cell: a curve may pass
/// through a straight line's middle.
constexpr double kLeastDeviation = 0.05;
constexpr double kSafety = 2.0;
/// A model so good has one zero at most, and Newton's method comes there.
constexpr double kNearlyLinear = 0.25;
constexpr double kSameRoot = 1e-6;

/// A part of the ranges, halved so often from a first cell.
struct Cell {
  AimPlace corner{};
  int depth = 0;
  bool operator<(const Cell& other) const { return std::tie(depth, corner) < std::tie(other.depth, other.corner); }
};

class CellSearch {
 public:
  CellSearch(AimFlights& flights, const std::function<bool()>& should_stop)
      : flights_(flights), should_stop_(should_stop), n_(flights.dimension()), grid_(kGrids[n_ - 1]) {}

  AimRoots run() {
    std::vector<Cell> cells(1, Cell{AimPlace(n_, 0.0)});
    for (std::size_t i = 0; i < n_; ++i) {
      std::vector<Cell> row;
      for (const Cell& cell : cells)
        for (int k = 0; k < grid_.cells; ++k) {
          row.push_back(cell);
          row.back().corner[i] = static_cast<double>(k) / grid_.cells;
        }
      cells = std::move(row);
    }
    for (const Cell& cell : cells) {
      if (is_over()) break;
      for (const std::string& label : labels_in(cell)) note_change(cell, label);
    }
    for (const Cell& cell : cells)
      for (const std::string& label : labels_in(cell)) queue(cell, label);
    // large cells first: where there are more of them than motions, small ones are left
    for (; !queue_.empty() && !is_over(); queue_.pop_front()) search(queue_.front().first, queue_.front().second);
    result_.is_incomplete = is_over_;
    return std::move(result_);
  }

 private:
  bool is_over() { return is_over_ = is_over_ || flights_.count() > grid_.most_motions || should_stop_(); }

  double width(const Cell& cell) const { return std::ldexp(1.0 / grid_.cells, -cell.depth); }

  AimPlace place_in(const Cell& cell, const Eigen::VectorXd& u) const {  // u: -1 … 1
    AimPlace place = cell.corner;
    for (std::size_t i = 0; i < n_; ++i)
      place[i] = std::clamp(place[i] + 0.5 * (1.0 + u[static_cast<Eigen::Index>(i)]) * width(cell), 0.0, 1.0);
    return place;
  }

  /// The corners, then the middle.
  std::vector<Eigen::VectorXd> nodes() const {
    std::vector<Eigen::VectorXd> nodes;
    for (std::size_t corner = 0; corner < (std::size_t{1} << n_); ++corner) {
      Eigen::VectorXd u(n_);
      for (std::size_t i = 0; i < n_; ++i) u[static_cast<Eigen::Index>(i)] = (corner >> i) % 2 == 1 ? 1.0 : -1.0;
      nodes.push_back(u);
    }
    nodes.push_back(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n_)));
    return nodes;
  }

  std::set<std::string> labels_in(const Cell& cell) {
    std::set<std::string> labels;
    for (const Eigen::VectorXd& u : nodes_) {
      if (is_over()) break;
      for (const Passage& passage : flights_.at(place_in(cell, u)).passages) labels.insert(passage.label);
    }
    return labels;
  }

  /// A label's passages at the nodes of a cell, null where it has none.
  std::vector<const Passage*> passages_in(const Cell& cell, const std::string& label) {
    std::vector<const Passage*> passages;
    for (const Eigen::VectorXd& u : nodes_) passages.push_back(flights_.at(place_in(cell, u)).passage(label));
    return passages;
  }

  /// How much a label's miss changes within a first cell.
  void note_change(const Cell& cell, const std::string& label) {
    const std::vector<const Passage*> passages = passages_in(cell, label);
    double change = -1.0;
    for (const Passage* a : passages)
      for (const Passage* b : passages)
        if (a != nullptr && b != nullptr && a != b) change = std::max(change, (a->residual - b->residual).norm());
    if (change >= 0.0) changes_[label].push_back(change);
  }

  /// The largest miss that a node of a cell can have beside a zero in the cell; infinite where that is not known. Of
  /// the changes in first cells three quarters are taken for smooth ones: a label jumps where the passages of a leg
  /// become more or fewer.
  double reach(const Cell& cell, const std::string& label) {
    constexpr double kMargin = 8.0;
    std::vector<double>& changes = changes_[label];
    if (changes.empty()) return std::numeric_limits<double>::infinity();
    const auto typical = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() * 3 / 4);
    std::nth_element(changes.begin(), typical, changes.end());
    return std::ldexp(kMargin * *typical, -cell.depth);
  }

  void queue(const Cell& cell, const std::string& label) {
    if (queued_.insert({cell, label}).second) queue_.emplace_back(cell, label);
  }

  void search(const Cell& cell, const std::string& label) {
    const std::vector<const Passage*> passages = passages_in(cell, label);
    const auto known = std::count_if(passages.begin(), passages.end(), [](const Passage* p) { return p != nullptr; });
    if (known == 0) return;
    if (known < static_cast<std::ptrdiff_t>(passages.size())) return search_at_border(cell, label, passages);

    const MissFrame frame(passages.back()->direction);
    LinearMiss model{.slope = Eigen::Matrix<double, 2, Eigen::Dynamic>::Zero(2, static_cast<Eigen::Index>(n_))};
    std::vector<Eigen::Vector2d> misses;
    const double share = 1.0 / static_cast<double>(nodes_.size() - 1);
    for (std::size_t k = 0; k < passages.size(); ++k) {
      misses.push_back(frame(*passages[k]));
      if (k + 1 == passages.size()) break;
      model.value += share * misses[k];
      model.slope += share * misses[k] * nodes_[k].transpose();
    }
    double deviation = 0.0, change = 0.0, largest = 0.0;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < misses.size(); ++k) {
      deviation = std::max(deviation, (misses[k] - model.value - model.slope * nodes_[k]).norm());
      change = std::max(change, (misses[k] - misses.back()).norm());
      largest = std::max(largest, misses[k].norm());
      smallest = std::min(smallest, misses[k].norm());
    }
    const Eigen::VectorXd best = least_within_box(model);
    const double least = (model.value + model.slope * best).norm();
    if (least > kSafety * std::max(deviation, kLeastDeviation * change)) return;

    constexpr int kFirstHalvings = 2;
    if (cell.depth >= kFirstHalvings && smallest > reach(cell, label)) return;  // a jump

    const bool is_family = static_cast<int>(n_) > model.rank();
    const double tolerance = flights_.at(place_in(cell, nodes_.back())).tolerance;
    if (largest <= tolerance) {  // all of the cell hits: a double zero
      add({place_in(cell, nodes_.back()), *passages.back(), is_family});
      return;
    }
    const bool is_deepest = cell.depth == (is_family ? std::min(kDeepestOfFamily, grid_.deepest) : grid_.deepest);
    const bool is_nearly_linear = deviation <= kNearlyLinear * model.slowest();
    if (is_nearly_linear || is_deepest) {
      const RootOutcome outcome = refine(cell, label, best, model, frame);
      if (outcome == RootOutcome::root || is_deepest || outcome == RootOutcome::none) {
        // a jump between two branches of a label is no near miss
        const bool is_likely = is_nearly_linear && least <= deviation;
        if (outcome == RootOutcome::stalled && is_likely) result_.has_stalled = true;
        return;
      }
    }
    halve(cell, label);
  }

  /// Some nodes do not have the label: nothing but the misses of the others tells whether it has a zero.
  void search_at_border(const Cell& cell, const std::string& label, const std::vector<const Passage*>& passages) {
    constexpr int kFirstHalvings = 3;
    const double farthest = reach(cell, label);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < passages.size(); ++k)
      if (passages[k] != nullptr && passages[k]->residual.norm() < least) {
        least = passages[k]->residual.norm();
        best = k;
      }
    if (least > farthest) return;
    const int deepest =
        std::isinf(farthest) ? std::min(kFirstHalvings, grid_.deepest_at_borders) : grid_.deepest_at_borders;
    if (cell.depth < deepest) return halve(cell, label);
    const MissFrame frame(passages[best]->direction);
    LinearMiss model;
    if (slopes_at(flights_, label, place_in(cell, nodes_[best]), 0.1 * width(cell), frame, model))
      refine_from(label, place_in(cell, nodes_[best]), model, frame);
  }

  void halve(const Cell& cell, const std::string& label) {
    std::set<std::string> parents = labels_in(cell);
    const double half = 0.5 * width(cell);
    for (std::size_t child = 0; child < (std::size_t{1} << n_); ++child) {
      Cell part{cell.corner, cell.depth + 1};
      for (std::size_t i = 0; i < n_; ++i)
        if ((child >> i) % 2 == 1) part.corner[i] += half;
      if (is_over()) return;
      queue(part, label);
      // what is seen here for the first time
      for (const std::string& other : labels_in(part))
        if (parents.count(other) == 0) queue(part, other);
    }
  }

  RootOutcome refine(const Cell& cell, const std::string& label, const Eigen::VectorXd& best, const LinearMiss& in_cell,
                     const MissFrame& frame) {
    const AimPlace start = place_in(cell, best);
    LinearMiss model = in_cell;
    model.slope /= 0.5 * width(cell);
    return refine_from(label, start, model, frame);
  }

  RootOutcome refine_from(const std::string& label, const AimPlace& start, const LinearMiss& model,
                          const MissFrame& frame) {
    AimRoot root;
    const RootOutcome outcome = refine_aim(flights_, label, start, model, frame, root);
    root.is_family = static_cast<int>(n_) > model.rank();
    if (outcome == RootOutcome::root) add(std::move(root));
    return outcome;
  }

  void add(AimRoot root) {
    for (AimRoot& known : result_.roots) {
      double distance = 0.0;
      for (std::size_t i = 0; i < n_; ++i) distance = std::max(distance, std::abs(known.place[i] - root.place[i]));
      if (distance > kSameRoot) continue;
      // one motion that comes there twice hits the first time
      const bool is_better = root.passage.label == known.passage.label ? root.passage.miss < known.passage.miss
                                                                       : root.passage.time < known.passage.time;
      if (is_better) known = std::move(root);
      return;
    }
    result_.roots.push_back(std::move(root));
  }

  AimFlights& flights_;
  const std::function<bool()>& should_stop_;
  std::size_t n_;
  Grid grid_;
  std::vector<Eigen::VectorXd> nodes_ = nodes();
  std::map<std::string, std::vector<double>> changes_;  // of each label's miss within first cells
  std::deque<std::pair<Cell, std::string>> queue_;
  std::set<std::pair<Cell, std::string>> queued_;  // ever
  AimRoots result_;
  bool is_over_ = false;
};

}  // namespace

AimRoots find_aim_roots(AimFlights& flights, const std::function<bool()>& should_stop) {
  return CellSearch(flights, should_stop).run();
}

}  // namespace trajet
