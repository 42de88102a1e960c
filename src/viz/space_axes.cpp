#include "space_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trajet::detail {

namespace {

/// Room for the numbers and names of the axes, in pixels.
constexpr double kLeft = 90.0, kRight = 76.0, kBottom = 58.0, kTop = 12.0;

std::vector<Vector3> corners(const Eigen::AlignedBox3d& box) {
  std::vector<Vector3> result;
  for (int i = 0; i < 8; ++i) result.emplace_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  return result;
}

/// In the coordinates of the picture.
Eigen::AlignedBox3d turned(const Eigen::AlignedBox3d& box, const PictureAxes& axes) {
  const Vector3 a = axes.turn() * box.min(), b = axes.turn() * box.max();
  return {Vector3(a.cwiseMin(b)), Vector3(a.cwiseMax(b))};
}

/// Without one scale: a box, in the coordinates of the picture, somewhat lower than wide.
Vector3 proportions(const Eigen::AlignedBox3d& box, bool one_scale) {
  return one_scale ? Vector3(1.0, 1.0, 1.0) : Vector3(Vector3(1.0, 1.0, 0.9).cwiseQuotient(box.sizes()));
}

Eigen::AlignedBox2d picture(const Eigen::AlignedBox3d& box, const Vector3& scale) {
  Eigen::AlignedBox2d rectangle;
  for (const Vector3& corner : corners(box)) rectangle.extend(Camera(scale).project(corner));
  return rectangle;
}

/// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10.0 * power;
}

struct Mark {
  double value;
  std::string text;
};

std::string mark_text(double value, double step, double size) {
  const std::optional<int> decimals = mark_decimals(step, size);
  return decimals ? number_text(value, *decimals) : short_text(value);
}

/// The marks of an axis, `spacing` pixels apart or more; `least`, where there would be no two of them. The numbers are
/// those of the world, whose axis lies along that of the picture with this `sign`.
std::vector<Mark> marks(double low, double high, double sign, double pixels, double spacing, double least) {
  std::vector<Mark> values;
  const double step = round_step((high - low) * spacing / std::max(pixels, 1.0));
  for (double k = std::ceil(low / step); k * step <= high; ++k)
    values.push_back({k * step, mark_text(sign * k * step, step, std::max(std::abs(low), std::abs(high)))});
  return values.size() < 2 && spacing > least ? marks(low, high, sign, pixels, std::max(0.7 * spacing, least), least)
                                              : values;
}

/// Numbers the labels of one panel; 1 and 2 are those of the figure's title.
class Labels {
 public:
  explicit Labels(SpaceAxes& axes) : axes_(axes) {}

  void add(const std::string& text, const Vector2& at, const std::string& style) {
    axes_.labels += fmt::format("set label {} {} at first {:.1f},{:.1f} {}\n", number_, text, at.x(), at.y(), style);
    axes_.end_labels += fmt::format("unset label {}\n", number_++);
  }
  void add(const Mark& mark, const Vector2& at, const std::string& style) {
    add(fmt::format("'{}'", mark.text), at, style);
  }

 private:
  SpaceAxes& axes_;
  int number_ = 10;
};

}  // namespace

double aspect(const Eigen::AlignedBox3d& world_box, bool one_scale, const PictureAxes& axes) {
  const Eigen::AlignedBox3d box = turned(world_box, axes);
  const Vector2 extent = picture(box, proportions(box, one_scale)).sizes();
  return extent.x() / extent.y();
}

View fit(const Eigen::AlignedBox3d& world_box, bool one_scale, const PictureAxes& axes, const Vector2& size) {
  const Eigen::AlignedBox3d box = turned(world_box, axes);
  Vector3 scale = proportions(box, one_scale);
  const Vector2 room(size.x() - kLeft - kRight, size.y() - kBottom - kTop);
  const Vector2 extent = picture(box, scale).sizes();
  scale *= std::min(room.x() / extent.x(), room.y() / extent.y());
  return {Camera(scale, axes), axes, Vector2(kLeft, kBottom) + 0.5 * room - picture(box, scale).center()};
}

SpaceAxes space_axes(const Eigen::AlignedBox3d& world_box, const View& view) {
  const Eigen::AlignedBox3d box = turned(world_box, view.axes);
  SpaceAxes result;
  Labels labels(result);
  const Vector3 &low = box.min(), &high = box.max();
  const auto at = [&](double x, double y, double z) {
    return view.pixels(view.axes.turn().transpose() * Vector3(x, y, z));
  };
  const auto length = [&](int axis) {
    Vector3 end = low;
    end[axis] = high[axis];
    return (at(end.x(), end.y(), end.z()) - at(low.x(), low.y(), low.z())).norm();
  };
  const auto name = [&](int axis) { return fmt::format("'{} [m]'", view.axes.name(axis)); };
  result.floor.push_back({at(low.x(), low.y(), low.z()), at(high.x(), low.y(), low.z()),
                          at(high.x(), high.y(), low.z()), at(low.x(), high.y(), low.z()),
                          at(low.x(), low.y(), low.z())});

  // x: along the front
  for (const Mark& mark : marks(low.x(), high.x(), view.axes.sign(0), length(0), 46.0, 32.0)) {
    const double x = mark.value;
    result.floor.push_back({at(x, low.y(), low.z()), at(x, high.y(), low.z())});
    result.walls.push_back({at(x, high.y(), low.z()), at(x, high.y(), high.z())});
    labels.add(mark, at(x, low.y(), low.z()) + Vector2(-6.0, -13.0), "center");
  }
  labels.add(name(0), at(0.5 * (low.x() + high.x()), low.y(), low.z()) + Vector2(-24.0, -38.0), "center");
  // y: along the right
  for (const Mark& mark : marks(low.y(), high.y(), view.axes.sign(1), length(1), 34.0, 30.0)) {
    const double y = mark.value;
    result.floor.push_back({at(low.x(), y, low.z()), at(high.x(), y, low.z())});
    result.walls.push_back({at(low.x(), y, low.z()), at(low.x(), y, high.z())});
    labels.add(mark, at(high.x(), y, low.z()) + Vector2(8.0, -7.0), "left");
  }
  labels.add(name(1), at(high.x(), 0.5 * (low.y() + high.y()), low.z()) + Vector2(32.0, -26.0), "left");
  // z: on the left
  for (const Mark& mark : marks(low.z(), high.z(), view.axes.sign(2), length(2), 36.0, 17.0)) {
    const double z = mark.value;
    result.walls.push_back({at(low.x(), low.y(), z), at(low.x(), high.y(), z), at(high.x(), high.y(), z)});
    labels.add(mark, at(low.x(), low.y(), z) + Vector2(-9.0, 0.0), "right");
    result.axes.push_back({at(low.x(), low.y(), z), at(low.x(), low.y(), z) + Vector2(-5.0, 0.0)});
  }
  labels.add(name(2), at(low.x(), low.y(), 0.5 * (low.z() + high.z())) + Vector2(-76.0, 0.0), "center rotate by 90");
  result.walls.push_back({at(low.x(), low.y(), high.z()), at(low.x(), high.y(), high.z()),
                          at(high.x(), high.y(), high.z()), at(high.x(), high.y(), low.z())});
  result.walls.push_back({at(low.x(), high.y(), low.z()), at(low.x(), high.y(), high.z())});
  result.axes.push_back({at(low.x(), low.y(), high.z()), at(low.x(), low.y(), low.z()), at(high.x(), low.y(), low.z()),
                         at(high.x(), high.y(), low.z())});
  return result;
}

}  // namespace trajet::detail
