#include "drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

/// Beyond so many faces a body is drawn as its outline.
constexpr std::size_t kMostFaces = 400;
constexpr int kCircleSides = 40;
constexpr Color kWhite = 0xffffff;
constexpr Color kBlack = 0x000000;

double area(const std::vector<Vector2>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * sum;
}

/// From where the viewer stands, light comes over the left shoulder.
double brightness(const Vector3& normal) {
  const Vector3 light = Vector3(-0.25, -0.55, 0.8).normalized();
  return std::max(0.0, normal.dot(light));
}

/// Bright faces are a tint of the colour, dark ones the colour itself.
Color lit(Color color, double brightness) { return mix(color, kWhite, 0.35 + 0.55 * brightness); }

std::vector<Vector2> closed(std::vector<Vector2> corners) {
  corners.push_back(corners.front());
  return corners;
}

/// The convex outline of points, counterclockwise: Andrew's monotone chain.
std::vector<Vector2> outline(std::vector<Vector2> points) {
  ranges::sort(points,
               [](const Vector2& a, const Vector2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector2> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2) {
        const Vector2 u = hull.back() - hull[hull.size() - 2], v = *point - hull.back();
        if (u.x() * v.y() - u.y() * v.x() > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

/// A ball seen from afar: the ellipse of the points where the line of sight is tangent.
std::vector<Vector2> ball_outline(const Vector3& center, double radius, const Camera& camera) {
  const Eigen::Matrix<double, 2, 3> m = camera.matrix();
  std::vector<Vector2> corners;
  for (int i = 0; i < kCircleSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleSides;
    const Vector3 direction = m.transpose() * Vector2(std::cos(angle), std::sin(angle));
    corners.push_back(camera.project(center + radius * direction.normalized()));
  }
  return corners;
}

/// The half of a great circle of a ball that the viewer sees.
std::vector<Vector2> visible_arc(const Pose& pose, double radius, const Vector3& u, const Vector3& v,
                                 const Camera& camera) {
  const auto point = [&](double angle) {
    return Vector3(pose.p_WB + radius * (pose.R_WB * Vector3(std::cos(angle) * u + std::sin(angle) * v)));
  };
  // nearness goes as a sine along the circle: the visible half is centred on its maximum
  const double center = camera.nearness(pose.p_WB);
  const double middle =
      std::atan2(camera.nearness(point(std::numbers::pi / 2)) - center, camera.nearness(point(0.0)) - center);
  std::vector<Vector2> line;
  for (int i = 0; i <= kCircleSides / 2; ++i)
    line.push_back(camera.project(point(middle + std::numbers::pi * (2.0 * i / kCircleSides - 0.5))));
  return line;
}

void draw_ball(const Look& look, const Pose& pose, const Camera& camera, Color color, Drawing& drawing) {
  drawing.polygons.push_back({ball_outline(pose.p_WB, look.ball_radius, camera), lit(color, 0.6)});
  drawing.lines.push_back(closed(drawing.polygons.back().corners));
  if (!look.turns) return;
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  drawing.lines.push_back(visible_arc(pose, look.ball_radius, x, y, camera));
  drawing.lines.push_back(visible_arc(pose, look.ball_radius, x, z, camera));
}

void draw_solid(const Look& look, const Pose& pose, const Camera& camera, Color color, bool small, Drawing& drawing) {
  const auto place = [&](const Vector3& p_B) { return Vector3(pose.p_WB + pose.R_WB * p_B); };
  if (small || look.faces.size() > kMostFaces) {
    std::vector<Vector2> points;
    for (const Face& face : look.faces)
      for (const Vector3& corner : face.corners) points.push_back(camera.project(place(corner)));
    drawing.polygons.push_back({outline(std::move(points)), lit(color, 0.6)});
    drawing.lines.push_back(closed(drawing.polygons.back().corners));
    return;
  }
  struct Seen {
    Drawing::Polygon polygon;
    double nearness;
  };
  std::vector<Seen> seen;
  for (const Face& face : look.faces) {
    Seen each{{}, 0.0};
    for (const Vector3& corner : face.corners) {
      each.polygon.corners.push_back(camera.project(place(corner)));
      each.nearness += camera.nearness(place(corner)) / static_cast<double>(face.corners.size());
    }
    if (area(each.polygon.corners) <= 0.0) continue;
    const double light = brightness((pose.R_WB * face.normal).normalized());
    const bool is_dark = look.has_dark_pentagons && face.corners.size() == 5;
    each.polygon.fill = is_dark ? mix(color, kBlack, 0.45) : lit(color, look.has_dark_pentagons ? 1.0 : light);
    seen.push_back(std::move(each));
  }
  ranges::stable_sort(seen, {}, &Seen::nearness);
  for (Seen& each : seen) {
    drawing.lines.push_back(closed(each.polygon.corners));
    drawing.polygons.push_back(std::move(each.polygon));
  }
}

std::string rows(const std::vector<Vector2>& points, const std::string& tail) {
  std::string text;
  for (const Vector2& point : points) text += fmt::format("{:.1f} {:.1f}{}\n", point.x(), point.y(), tail);
  return text + "\n";
}

}  // namespace

Color mix(Color from, Color to, double part) {
  Color result = 0;
  for (int shift = 16; shift >= 0; shift -= 8) {
    const double a = (from >> shift) & 0xff, b = (to >> shift) & 0xff;
    result |= static_cast<int>(a + part * (b - a) + 0.5) << shift;
  }
  return result;
}

std::string color_text(Color color) { return fmt::format("#{:06x}", color); }

Color color_or(const std::optional<RgbColor>& given, Color otherwise) {
  return given ? given->red << 16 | given->green << 8 | given->blue : otherwise;
}

Color obstacle_color(const World::Obstacle& obstacle) {
  constexpr Color kGrey = 0x8a8a80;
  return color_or(obstacle.color, kGrey);
}

Color line_color(Color color) {
  constexpr double kLightest = 0.7;
  const double red = (color >> 16) & 0xff, green = (color >> 8) & 0xff, blue = color & 0xff;
  const double lightness = (0.3 * red + 0.59 * green + 0.11 * blue) / 255.0;
  return lightness <= kLightest ? color : mix(color, kBlack, 1.0 - kLightest / lightness);
}

double Look::radius() const {
  double radius = ball_radius;
  for (const Face& face : faces)
    for (const Vector3& corner : face.corners) radius = std::max(radius, corner.norm());
  for (const Vector3& point : points) radius = std::max(radius, point.norm());
  return radius;
}

Look look(const World::Body& body) {
  Look look{.faces = faces(picture_mesh(body.solid)), .turns = body.rotation.has_value()};
  look.has_dark_pentagons = std::holds_alternative<SoccerBall>(body.solid);
  if (const auto* ball = std::get_if<Ball>(&body.solid)) look.ball_radius = ball->radius;
  if (look.faces.empty() && look.ball_radius == 0.0)
    for (const World::Point& point : body.points) look.points.push_back(point.p_B);
  return look;
}

Drawing moved(Drawing drawing, const Vector2& by) {
  for (Drawing::Polygon& polygon : drawing.polygons)
    for (Vector2& corner : polygon.corners) corner += by;
  for (auto& line : drawing.lines)
    for (Vector2& point : line) point += by;
  return drawing;
}

Drawing draw_body(const Look& look, const Pose& pose, const Camera& camera, Color color, bool small) {
  Drawing drawing{.line_color = mix(color, kBlack, 0.25), .nearness = camera.nearness(pose.p_WB)};
  if (look.ball_radius > 0.0) draw_ball(look, pose, camera, color, drawing);
  if (!look.faces.empty()) draw_solid(look, pose, camera, color, small, drawing);
  if (!look.points.empty()) {
    drawing.line_color = color;
    drawing.line_width = 2.4;
  }
  for (const Vector3& point : look.points)
    drawing.lines.push_back({camera.project(pose.p_WB), camera.project(pose.p_WB + pose.R_WB * point)});
  return drawing;
}

Drawing draw_faces(const std::vector<Face>& faces, const Camera& camera, Color color, bool from_front) {
  Drawing drawing{.line_color = mix(color, kBlack, 0.2)};
  std::vector<std::pair<double, Drawing::Polygon>> sorted;
  for (const Face& face : faces) {
    if (face.corners.empty()) continue;
    double nearness = 0.0;
    Drawing::Polygon polygon{{}, lit(color, std::max(brightness(face.normal), brightness(-face.normal)))};
    for (const Vector3& corner : face.corners) {
      polygon.corners.push_back(camera.project(corner));
      nearness += camera.nearness(corner) / static_cast<double>(face.corners.size());
    }
    if (from_front && area(polygon.corners) <= 0.0) continue;
    drawing.nearness += nearness / static_cast<double>(faces.size());
    sorted.emplace_back(nearness, std::move(polygon));
  }
  ranges::stable_sort(sorted, {}, [](const auto& each) { return each.first; });
  for (auto& [nearness, polygon] : sorted) {
    drawing.lines.push_back(closed(polygon.corners));
    drawing.polygons.push_back(std::move(polygon));
  }
  return drawing;
}

PlotElements plot_elements(const Drawing& drawing, const std::string& name) {
  PlotElements result;
  const auto add = [&](const std::string& suffix, const std::string& text, const std::string& style) {
    result.data += fmt::format("${}{} << EOD\n{}EOD\n", name, suffix, text);
    result.elements += fmt::format("{}${}{} {} notitle", result.elements.empty() ? "" : ", ", name, suffix, style);
  };
  std::string text;
  for (const Drawing::Polygon& polygon : drawing.polygons)
    text += rows(polygon.corners, fmt::format(" {}", polygon.fill));
  if (!text.empty())
    add("f", text,
        fmt::format("using 1:2:3 with filledcurves closed fs {} noborder fc rgb variable",
                    drawing.opacity < 1.0 ? fmt::format("transparent solid {:.2f}", drawing.opacity) : "solid 1"));
  text.clear();
  for (const auto& line : drawing.lines) text += rows(line, "");
  if (!text.empty())
    add("l", text, fmt::format("with lines lw {:.1f} lc '{}'", drawing.line_width, color_text(drawing.line_color)));
  return result;
}

}  // namespace trajet::detail
