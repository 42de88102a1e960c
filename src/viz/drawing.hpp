#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera.hpp"
#include "trajet/geom/faces.hpp"
#include "trajet/viz/pose.hpp"

namespace trajet::detail {

/// A colour as 0xRRGGBB.
using Color = int;
/// `part` of the way from one colour to another.
Color mix(Color from, Color to, double part);
std::string color_text(Color color);  // as '#rrggbb'
/// What a scene says of a body or an obstacle, or else `otherwise`.
Color color_or(const std::optional<RgbColor>& given, Color otherwise);
Color obstacle_color(const World::Obstacle& obstacle);
/// A colour for lines on white paper: those that are too light for it become darker.
Color line_color(Color color);

/// What a body looks like, in its own frame.
struct Look {
  std::vector<Face> faces{};      // of solids
  double ball_radius = 0.0;       // m, of balls
  std::vector<Vector3> points{};  // of bodies without extent: lines lead to them from the centre
  bool has_dark_pentagons = false;
  bool turns = false;

  bool is_empty() const { return faces.empty() && ball_radius == 0.0 && points.empty(); }
  /// m, around the centre.
  double radius() const;
};
Look look(const World::Body& body);

/// Part of a picture: filled polygons, the first one beneath the others, and lines over them.
struct Drawing {
  struct Polygon {
    std::vector<Vector2> corners;
    Color fill;
  };
  std::vector<Polygon> polygons{};
  std::vector<std::vector<Vector2>> lines{};
  Color line_color = 0;
  double line_width = 1.0;
  double opacity = 1.0;   // of the polygons
  double nearness = 0.0;  // of the middle: what is nearer is drawn later
};

/// The drawing, moved by so much.
Drawing moved(Drawing drawing, const Vector2& by);
/// A body as it stands. Lit from above; what faces away is not drawn. Of what has very many faces, or is to be drawn
/// `small`, only the outline.
Drawing draw_body(const Look& look, const Pose& pose, const Camera& camera, Color color, bool small = false);
/// Flat pieces of any shape, lit and drawn from both sides, farther ones beneath; of what is seen `from_front` only,
/// not those that face away.
Drawing draw_faces(const std::vector<Face>& faces, const Camera& camera, Color color, bool from_front = false);

/// The data and the elements of a `plot` command, comma between them, that show a drawing; `name` is that of its data
/// blocks. Picture coordinates are those of the plot.
struct PlotElements {
  std::string data;
  std::string elements;
};
PlotElements plot_elements(const Drawing& drawing, const std::string& name);

}  // namespace trajet::detail
