#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trajet/study/compare.hpp"
#include "trajet/viz/curve.hpp"
#include "trajet/viz/gnuplot.hpp"
#include "trajet/viz/pose.hpp"

namespace trajet {

/// The motion of one row of a comparison, for its figure.
struct RowMotion {
  std::vector<Curve> curves;             ///< of each group of the World
  std::vector<std::vector<Pose>> poses;  ///< of each body of the World: none where it does not turn
};
RowMotion make_row_motion(const MotionRecord& record);

/// One component of the state of a World, to draw against time.
struct ShownComponent {
  int group;
  int index;          ///< in the group's state
  std::string label;  ///< with its unit
};
/// The component of that name: `ball.z`, `ball.vx`, or an extra state. Throws InputError at `where` for another name.
ShownComponent find_component(const World& world, const std::string& name, const SourceLocation& where);

/// The figure of a comparison: the motions over the reference, which is red (`euler` is blue, `rk4` black, as in the
/// course), and the error against the number of law evaluations and against time, both scales logarithmic.
///
/// Of more than six rows it draws the motion with the largest error of each method, for the six methods with the
/// largest ones: others lie on the reference. They are drawn in space, in a plane or against time, as the motion needs,
/// or `component` against time; solids that turn as they stand along their ways, and below one another as seen from
/// their centres. `motions` has an entry for each row of the comparison, `world` is one of its Worlds.
Figure compare_figure(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
                      const std::optional<ShownComponent>& component = std::nullopt);

}  // namespace trajet
