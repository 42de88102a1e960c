#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/law/pinned_law.hpp"
#include "trajet/law/sliding_law.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {

/// The branches on which a law is in the course of a motion, as far as the state decides, and where they end.
///
/// Where the branches on both sides of a border lead back to it, the motion slides along it, by such shares of both
/// laws that it stays there [Filippov1988], until one of them leads away.
class LawBranches {
 public:
  explicit LawBranches(const Program& law);
  LawBranches(const LawBranches&) = delete;  // its evaluators point to its programs
  LawBranches& operator=(const LawBranches&) = delete;

  /// The law without choices: what its pins have to be, `pins` says.
  const PinnedLaw& pinned() const { return pinned_; }

  /// What the branches were found to be.
  enum class Finding {
    decided,
    moved,      ///< the motion is to start from a state that differs by rounding, `displacement`
    undefined,  ///< what decides is not a number
    undecided,  ///< whichever branch is taken leads back to the border, and there is no sliding along it either
  };
  /// The motion starts anew at time `t` in state `q`, forward in time or backward: which branches it is on.
  Finding begin(double t, const double* q, double direction);

  /// Where a motion on the branches leaves the first of them.
  struct End {
    double time = 0.0;      ///< s
    int border = 0;         ///< that it passes, or along which it has slid
    double at = 0.0;        ///< the border's value
    double onward = 0.0;    ///< -1 or 1: to which side of it
    bool is_slip = false;   ///< it has slid along the border
    bool is_known = false;  ///< else it was not told whether a branch ends from `time` on
  };
  /// On a step that was made by the law on the branches.
  std::optional<End> find_end(const Segment<>& segment);
  /// The motion goes on from an end at time `t` in state `q`, on the branches that it finds there.
  Finding pass(const End& end, double t, const double* q, double direction);

  /// How fast a border's function changes with each component of the state and, the last one, with time, on the
  /// branches that were found last.
  Eigen::RowVectorXd gradient(int border, double t, const double* q);

  /// A constant of the pinned law.
  struct PinValue {
    std::int32_t slot;
    double value;
  };
  std::span<const PinValue> pins() const { return pins_; }
  /// Along what the motion slides; then its law is `sliding_law` instead of the pinned one.
  std::span<const SlidingBorder> sliding() const;
  const Program& sliding_law() const { return sliding_->law.law; }
  /// For how long the motion is to go on, s: what is displaced is so by less than that rounds to.
  void set_horizon(double duration) { horizon_ = duration; }
  /// What is to be added to the state: a vector that vanishes, and whose direction the law reads, has one then, or is
  /// exactly zero where the law holds it there.
  const Eigen::VectorXd& displacement() const { return displacement_; }
  /// How long the vectors whose directions the law reads, and that it may hold at zero, take to come there at their
  /// rates at time `t`, s; nothing where none is on its way there.
  struct Approach {
    int border;  ///< the direction's
    double duration;
    bool is_there;  ///< to rounding, and to what the state may be off by
  };
  std::optional<Approach> approach(double t, const double* q, double direction, const Eigen::VectorXd& error);
  /// Those on which it was not decided what becomes of the motion.
  std::span<const int> undecided() const { return undecided_; }

 private:
  /// A border that the motion is on, to rounding.
  struct Near {
    int border;
    double at;
    double onward;  // -1 or 1: the side that was tried last
    int changes = 0;
  };
  /// The law along borders, at work.
  struct Sliding {
    Sliding(std::vector<SlidingBorder> along, SlidingLaw their_law);
    std::vector<SlidingBorder> borders;
    SlidingLaw law;
    std::vector<int> inputs;  // that the shares read
    Evaluator<double> rate, residuals, holds;
    Evaluator<IntervalJet> rate_jets, shares;
    std::vector<IntervalJet> share_values;
  };

  /// Of all functions by state and time.  // (functions x (state + 1))
  Eigen::MatrixXd function_derivatives(double t, const double* q) const;
  const PinnedLaw::Border& border(int index) const { return pinned_.borders[static_cast<std::size_t>(index)]; }
  std::size_t function_of(int index) const { return static_cast<std::size_t>(border(index).function); }
  Interval value(int index) const { return values_[function_of(index)][0]; }
  /// The functions where each component of the state is known to some roundings, and changes with time as it does.
  void evaluate_values(double t, const double* q);
  /// The functions and their derivatives along the motion, the second one as the law's own derivative has it.
  void evaluate_jets(double t, const double* q);
  Finding find_sides(double t, const double* q, double direction, const End* passed);
  /// Puts the motion on the sides of those that are near to which it goes by the law there.
  Finding settle(std::vector<Near>& near, double t, const double* q, double direction);
  /// The same where some lead back on both sides: it slides along them.
  Finding slide(std::vector<Near>& near, double t, const double* q, double direction);
  Finding slide_along(std::vector<SlidingBorder> along, std::vector<Near>& near, double t, const double* q,
                      double direction);
  // Directions, in law_holds.cpp.
  const PinnedLaw::Direction& direction_of(int index) const { return pinned_.direction(index); }
  bool is_near_zero(int direction) const;
  Eigen::VectorXd vector_of(int direction, double t, const double* q);
  /// The derivative of its vector by state and time.  // (components x (state + 1))
  Eigen::MatrixXd derivative_of(int direction, double t, const double* q);
  /// The change of the state, the smallest one, that gives the vector that value.
  Eigen::VectorXd change_to(int direction, const Eigen::VectorXd& value, double t, const double* q);
  /// Whether the law holds the vectors of directions at zero.
  Finding hold_directions(std::vector<Near>& near, double t, const double* q, double direction, const End* passed,
                          const std::vector<SlidingBorder>& slid);
  /// Takes from `along` what does not hold the motion, and puts it on the side to which that is left. Whether the rest
  /// is to be tried anew.
  bool leave_border(std::vector<SlidingBorder>& along, double t, const double* q);
  bool shares_tell_all(double t, const double* q);
  /// Puts those that are not near on the sides that their functions have; whether one was on another.
  bool update_far_sides(const std::vector<Near>& near, double t, const double* q);
  void set_side(int index, const BorderSide& side);
  std::optional<End> find_border_end(const Segment<>& segment, int index);
  std::optional<End> find_slip(const Segment<>& segment, std::size_t which);

  PinnedLaw pinned_;
  std::vector<int> inputs_;  // components of the state that the functions read
  std::vector<BorderSide> sides_;
  std::vector<PinValue> pins_;
  std::vector<std::size_t> first_pin_;  // of each border
  Evaluator<double> law_;
  Evaluator<IntervalJet> law_jets_, functions_;
  std::vector<double> rate_;
  std::vector<IntervalJet> state_, rate_jets_, values_;
  std::unique_ptr<Sliding> sliding_;
  std::vector<int> undecided_;
  Eigen::VectorXd displacement_;
  double horizon_ = 0.0;
  std::vector<bool> repels_;  // directions in which the law drives their vectors away from zero, as last found
};

}  // namespace trajet
