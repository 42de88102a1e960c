#include "page_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "base64.hpp"
#include "trajet/geom/cavity.hpp"
#include "trajet/geom/shape_pictures.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/scene/driven_frame.hpp"

namespace trajet::detail {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

Json array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Json object(const Plane& plane) {
  return {{"kind", "plane"}, {"point", array(plane.point)}, {"normal", array(plane.normal)}};
}

Json object(const Disk& disk) {
  return {{"kind", "disk"}, {"center", array(disk.center)}, {"normal", array(disk.normal)}, {"radius", disk.radius}};
}

Json object(const Rectangle& rectangle) {
  return {{"kind", "rectangle"},       {"center", array(rectangle.center)}, {"normal", array(rectangle.normal)},
          {"up", array(rectangle.up)}, {"width", rectangle.width},          {"height", rectangle.height}};
}

Json object(const Triangle& triangle) {
  return {{"kind", "triangle"},
          {"corners", {array(triangle.corners[0]), array(triangle.corners[1]), array(triangle.corners[2])}}};
}

Json object(const Sphere& sphere) {
  return {{"kind", "sphere"}, {"center", array(sphere.center)}, {"radius", sphere.radius}};
}

Json object(const Box& box) {
  const Matrix3& R = box.R_WB;
  return {{"kind", "box"},
          {"center", array(box.center)},
          {"size", array(2.0 * box.half_size)},
          {"axes", {array(R.col(0)), array(R.col(1)), array(R.col(2))}}};
}

Json object(const TriangleMesh& mesh, bool is_closed) {
  Json shape = {{"kind", "mesh"}, {"vertices", Json::array()}, {"triangles", mesh.triangles}};
  for (const Vector3& vertex : mesh.vertices) shape["vertices"].push_back(array(vertex));
  shape["closed"] = is_closed;
  return shape;
}

Json object(const MeshSurface& surface) { return object(picture_of(surface), surface.triangles->is_closed); }

Json object(const SolidOfRevolution& solid) {
  return object(placed(local_picture(solid), solid.center, solid.R_WB), true);
}

Json object(const EllipsoidBody& ellipsoid) {
  return object(placed(local_picture(ellipsoid), ellipsoid.center, ellipsoid.R_WB), true);
}

Json object(const Cavity& cavity) {
  Json shape = object(cavity.walls->picture, true);
  shape["hollow"] = true;
  return shape;
}

/// Degrees are packed into doubles, which hold integers of 53 bits.
constexpr int kDegreesOfNumber = 6;
constexpr double kDegreeBase = 256.0;

/// The degree of a component's polynomial, at most 255, without the coefficients behind the last one that changes its
/// value in double precision within `duration` (s).
int significant_degree(const Segment<>& segment, int component, double duration) {
  const auto& c = segment.coefficients();
  double largest = 0.0;
  double power = 1.0;
  for (int k = 0; k <= segment.degree(); ++k, power *= duration)
    largest = std::max(largest, std::abs(c(component, k)) * power);
  constexpr double kHalfUlp = 0x1p-53;
  int degree = 0;
  power = 1.0;
  for (int k = 0; k <= segment.degree() && k < kDegreeBase; ++k, power *= duration)
    if (std::abs(c(component, k)) * power > kHalfUlp * largest) degree = k;
  return degree;
}

/// Appends a piece as numbers, its times those of the clock that shows `epoch` at the start: from, to, the Segment's
/// t0, the degrees of all components, six to a number as its digits to the base 256, the first the least, and then the
/// coefficients of each component, (t - t0)^0 first.
void append(std::vector<double>& numbers, const RecordedPiece& piece, double epoch) {
  const Segment<>& segment = piece.segment;
  numbers.insert(numbers.end(), {epoch + piece.from, epoch + piece.to, epoch + segment.t0()});
  std::vector<int> degrees;
  for (int i = 0; i < segment.dimension(); ++i) {
    degrees.push_back(significant_degree(segment, i, std::abs(segment.duration())));
    if (i % kDegreesOfNumber == 0) numbers.push_back(0.0);
    numbers.back() += degrees.back() * std::pow(kDegreeBase, i % kDegreesOfNumber);
  }
  for (int i = 0; i < segment.dimension(); ++i)
    for (int k = 0; k <= degrees[static_cast<std::size_t>(i)]; ++k) numbers.push_back(segment.coefficients()(i, k));
}

/// Gives all pieces that `for_each` has, one after the other, as parts of a text in base64.
template <class ForEach>
void write_packed(const ForEach& for_each, double epoch, const std::function<void(const std::string&)>& add) {
  constexpr std::size_t kWhole = 3;  // so many doubles have a whole number of base64's groups of three bytes
  std::vector<double> numbers;
  const auto write = [&](std::size_t count) {
    add(base64({reinterpret_cast<const std::uint8_t*>(numbers.data()), count * sizeof(double)}));
    numbers.erase(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
  };
  for_each([&](const RecordedPiece& piece) {
    append(numbers, piece, epoch);
    write(numbers.size() - numbers.size() % kWhole);
  });
  write(numbers.size());
}

/// How an obstacle moves on the way of a run of that duration (s).
Json drive_data(const World::Drive& drive, double duration, double epoch) {
  DrivenFrame frame(drive);
  const auto each_piece = [&](const auto& use) {
    RecordedPiece kept;
    for (double t = 0.0; t < duration;) {
      const Segment<7> piece = frame.piece(t, duration);
      if (!(piece.t1() > t)) break;
      kept.segment.resize(piece.dimension(), piece.degree());
      kept.segment.coefficients() = piece.coefficients();
      kept.segment.set_interval(piece.t0(), piece.t1());
      kept.from = t;
      kept.to = t = piece.t1();
      use(kept);
    }
  };
  std::string packed;
  write_packed(each_piece, epoch, [&](const std::string& part) { packed += part; });
  return {{"pivot", array(drive.pivot)}, {"pieces", packed}};
}

/// What a program's output is worth where its formula needs neither time nor state.
std::optional<double> constant_output(const Program& program, int output) {
  for (const Program::Constant& constant : program.constants)
    if (constant.slot == program.outputs[static_cast<std::size_t>(output)]) return constant.value.value;
  return std::nullopt;
}

/// A body's mass in kg where it is constant, else null.
Json constant_mass(const World::Body& body) {
  const std::optional<double> mass = body.mass ? constant_output(*body.mass, 0) : std::nullopt;
  return mass ? Json(*mass) : Json();
}

/// What a body's law says of its acceleration where that is constant, m/s^2, else null.
Json constant_acceleration(const World::Body& body, const Program& law) {
  Json acceleration;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> component = constant_output(law, body.slice().velocity_index() + i);
    if (!component) return nullptr;
    acceleration.push_back(*component);
  }
  return acceleration;
}

/// A solid as the page draws it: what has flat faces, or is drawn with some, is a mesh.
Json shape_data(const Solid& solid) {
  if (const auto* ball = std::get_if<SoccerBall>(&solid)) return {{"kind", "soccer-ball"}, {"radius", ball->radius}};
  if (const auto* ball = std::get_if<Ball>(&solid)) return {{"kind", "sphere"}, {"radius", ball->radius}};
  const TriangleMesh surface = picture_mesh(solid);
  if (surface.triangles.empty()) return {{"kind", "point"}};
  Json shape = {{"kind", "mesh"}, {"vertices", Json::array()}, {"triangles", surface.triangles}};
  for (const Vector3& vertex : surface.vertices) shape["vertices"].push_back(array(vertex));
  return shape;
}

std::string_view kind(OrientationWay way) {
  switch (way) {
    case OrientationWay::matrix:
      return "matrix";
    case OrientationWay::rotation_vector:
      return "rotation-vector";
    case OrientationWay::quaternion_normalized:
    case OrientationWay::quaternion:
    case OrientationWay::exact:
      break;
  }
  return "quaternion";
}

Json object(const World::Rotation& rotation, const BodySlice& slice) {
  Json inertia;
  if (rotation.inertia)
    for (int row = 0; row < 3; ++row) inertia.push_back(array(Vector3(rotation.inertia->row(row))));
  return {{"kind", kind(rotation.layout.way)},
          {"component", slice.orientation_index()},
          {"angular_velocity", slice.angular_velocity_index()},
          {"frame", rotation.layout.frame == Frame::world ? "world" : "body"},
          {"free", rotation.is_free},
          {"inertia", inertia}};
}

Json body_data(const World::Body& body, const World::Group& group) {
  const Quaternion& q = body.q_WB;
  const BodySlice slice = body.slice();
  Json data = {{"name", body.name},
               {"shape", shape_data(body.solid)},
               {"mass", constant_mass(body)},
               {"group", body.group},
               {"field", constant_acceleration(body, group.law)},
               {"position", slice.position_index()},
               {"velocity", slice.velocity_index()},
               {"points", Json::array()},
               {"attitude", {q.w(), q.x(), q.y(), q.z()}}};
  for (const World::Point& point : body.points)
    data["points"].push_back({{"name", point.name}, {"position", array(point.p_B)}});
  if (body.color) data["color"] = color_text(*body.color);
  if (body.rotation) data["rotation"] = object(*body.rotation, slice);
  return data;
}

/// The box around all ways.
Aabb span_of(const RecordedMotion& motion) {
  Aabb box;
  const World& world = motion.world();
  for (const World::Body& body : world.bodies) {
    const auto pieces = motion.read(body.group);
    while (const RecordedPiece* const next = pieces->next()) {
      const RecordedPiece& piece = *next;
      constexpr int kParts = 8;  // enough that no bend of a long piece is missed
      for (int i = 0; i <= kParts; ++i) {
        const double t = piece.from + (piece.to - piece.from) * i / kParts;
        const auto at = [&](int axis) { return piece.segment.value(body.slice().position_index() + axis, t); };
        box = united(box, Vector3(at(0), at(1), at(2)));
      }
    }
  }
  return is_bounded(box) ? box : Aabb{Vector3(-1, -1, -1), Vector3(1, 1, 1)};
}

/// The way in which a run carries orientations, null where nothing turns.
Json orientation_way(const World& world) {
  for (const World::Body& body : world.bodies)
    if (body.rotation) return orientation_info(body.rotation->layout.way).name;
  return nullptr;
}

}  // namespace

void write_page_data(const PageRun& run, ScriptText& text) {
  const World& world = run.motion.world();
  text.add(R"({"report":)");
  run.report([&](std::string_view part) { text.add_laid_out(part); });
  Json bodies = Json::array(), states = Json::array(), obstacles = Json::array();
  for (const World::Body& body : world.bodies)
    bodies.push_back(body_data(body, world.groups[static_cast<std::size_t>(body.group)]));
  for (const World::ExtraState& state : world.states)
    states.push_back({{"name", state.name}, {"group", state.group}, {"component", state.offset}});
  for (const World::Obstacle& obstacle : world.obstacles) {
    const auto* cavity = std::get_if<Cavity>(&obstacle.shape);
    if (cavity != nullptr && cavity->walls->picture.triangles.empty()) continue;  // of a room, the first wall shows all
    Json shape = std::visit(
        [&](const auto& each) {
          if constexpr (std::is_same_v<std::decay_t<decltype(each)>, Terrain>)
            return object(picture(each, span_of(run.motion)), false);
          else
            return object(each);
        },
        obstacle.shape);
    obstacles.push_back({{"name", obstacle.name}, {"shape", std::move(shape)}});
    if (obstacle.color) obstacles.back()["color"] = color_text(*obstacle.color);
    if (obstacle.drive) obstacles.back()["drive"] = drive_data(*obstacle.drive, world.duration, world.epoch);
  }
  const auto add_member = [&](std::string_view key, const Json& value) {
    text.add(",\"" + std::string(key) + "\":");
    text.add_value(value);
  };
  add_member("up", world.up == UpAxis::y ? "y" : "z");
  add_member("orientation", orientation_way(world));
  add_member("bodies", bodies);
  add_member("states", states);
  add_member("obstacles", obstacles);
  text.add(R"(,"groups":[)");
  for (std::size_t g = 0; g < world.groups.size(); ++g) {
    text.add((g == 0 ? R"({"dimension":)" : R"(,{"dimension":)") + std::to_string(world.groups[g].start.size()));
    text.add(R"(,"pieces":")");
    const auto each_piece = [&](const auto& use) {
      const auto pieces = run.motion.read(static_cast<int>(g));
      while (const RecordedPiece* const piece = pieces->next()) use(*piece);
    };
    write_packed(each_piece, world.epoch, [&](const std::string& part) { text.add(part); });
    text.add(R"("})");
  }
  text.add("]}");
}

}  // namespace trajet::detail
