#include "trajet/io/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "gltf_keys.hpp"
#include "gltf_records.hpp"
#include "gltf_shapes.hpp"
#include "tiny_gltf.hpp"
#include "trajet/error.hpp"
#include "trajet/portable.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using detail::AnimationKeys;
using detail::GltfMesh;
using detail::Pose;
using detail::Tint;
using Value = tinygltf::Value;
using LinearColor = std::array<double, 3>;

/// Colours of bodies, linear: those of [OkabeIto2008].
constexpr std::array<LinearColor, 6> kBodyColors{{{0.0, 0.168, 0.445},
                                                  {0.791, 0.347, 0.0},
                                                  {0.604, 0.191, 0.386},
                                                  {0.0, 0.342, 0.171},
                                                  {0.665, 0.112, 0.0},
                                                  {0.093, 0.456, 0.815}}};
constexpr LinearColor kObstacleColor{0.35, 0.38, 0.42};
constexpr LinearColor kLightColor{0.9, 0.9, 0.87};
constexpr LinearColor kDarkColor{0.012, 0.012, 0.016};

/// What glTF calls a colour: the light itself, of which sRGB tells how bright it seems.
LinearColor linear(const RgbColor& color) {
  const auto part = [](std::uint8_t value) {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {part(color.red), part(color.green), part(color.blue)};
}

LinearColor tinted(const LinearColor& own, Tint tint) {
  switch (tint) {
    case Tint::own:
      return own;
    case Tint::light:
      return kLightColor;
    case Tint::dark:
      return kDarkColor;
  }
  return own;
}

/// Builds the model: everything lies in one buffer, each accessor in a view of its own.
class ModelBuilder {
 public:
  ModelBuilder() {
    model_.asset.version = "2.0";
    model_.asset.generator = std::string("trajet ") + kVersion;
    model_.buffers.emplace_back();
  }

  int add_mesh(const std::string& name, const GltfMesh& data, const LinearColor& color) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    const int positions = add_floats(data.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    const int normals = add_floats(data.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const auto& [tint, triangles] : data.triangles) {
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes["POSITION"] = positions;
      primitive.attributes["NORMAL"] = normals;
      primitive.indices = add_accessor(triangles.data(), triangles.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                       TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
      primitive.material = add_material(name, tinted(color, tint));
      mesh.primitives.push_back(std::move(primitive));
    }
    return append(model_.meshes, std::move(mesh));
  }

  /// The node that all others stand under.
  int add_root(const std::string& name) {
    tinygltf::Node node;
    node.name = name;
    return append(model_.nodes, std::move(node));
  }

  int add_node(const std::string& name, int mesh, int parent) {
    tinygltf::Node node;
    node.name = name;
    node.mesh = mesh;
    const int index = append(model_.nodes, std::move(node));
    this->node(parent).children.push_back(index);
    return index;
  }

  tinygltf::Node& node(int index) { return model_.nodes[static_cast<std::size_t>(index)]; }

  /// The frame of a node in its parent's.
  void place(int node, const Pose& pose) {
    this->node(node).translation = {pose.position.x(), pose.position.y(), pose.position.z()};
    const Quaternion& q = pose.q_WB;
    if (!q.isApprox(Quaternion::Identity())) this->node(node).rotation = {q.x(), q.y(), q.z(), q.w()};
  }

  void add_animation(int node, const AnimationKeys& keys, bool turns) {
    const int input = add_floats(keys.times, 0);
    add_channel(node, "translation", input, add_floats(keys.positions, 0));
    if (turns) add_channel(node, "rotation", input, add_floats(keys.rotations, 0));
  }

  std::string write(const std::string& title) && {
    tinygltf::Scene scene;
    scene.name = title;
    scene.nodes = {0};
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
    if (!animation_.channels.empty()) {
      animation_.name = title.empty() ? "motion" : title;
      model_.animations.push_back(std::move(animation_));
    }
    std::ostringstream stream;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true))
      throw FileError("the animation cannot be written as glTF");
    return std::move(stream).str();
  }

 private:
  template <class T>
  static int append(std::vector<T>& items, T item) {
    items.push_back(std::move(item));
    return static_cast<int>(items.size()) - 1;
  }

  int add_material(const std::string& name, const LinearColor& color) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {color[0], color[1], color[2], 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    material.doubleSided = true;
    return append(model_.materials, std::move(material));
  }

  /// Columns of floats, with the least and the greatest of each component.
  template <int Size>
  int add_floats(const std::vector<Eigen::Matrix<float, Size, 1>>& columns, int target) {
    constexpr int kType = Size == 1 ? TINYGLTF_TYPE_SCALAR : Size == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
    static_assert(sizeof(Eigen::Matrix<float, Size, 1>) == Size * sizeof(float), "columns lie without gaps");
    const int index = add_accessor(columns.data(), columns.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, kType, target);
    const Eigen::Map<const Eigen::MatrixXf> all(columns.front().data(), Size,
                                                static_cast<Eigen::Index>(columns.size()));
    for (int i = 0; i < Size; ++i) {
      tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
      accessor.minValues.push_back(static_cast<double>(all.row(i).minCoeff()));
      accessor.maxValues.push_back(static_cast<double>(all.row(i).maxCoeff()));
    }
    return index;
  }

  template <class T>
  int add_accessor(const T* items, std::size_t count, int component_type, int type, int target) {
    std::vector<unsigned char>& bytes = model_.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = count * sizeof(T);
    view.target = target;
    const auto* first = reinterpret_cast<const unsigned char*>(items);
    bytes.insert(bytes.end(), first, first + view.byteLength);
    tinygltf::Accessor accessor;
    accessor.bufferView = append(model_.bufferViews, std::move(view));
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    return append(model_.accessors, std::move(accessor));
  }

  void add_channel(int node, const std::string& path, int input, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = append(animation_.samplers, std::move(sampler));
    channel.target_node = node;
    channel.target_path = path;
    animation_.channels.push_back(std::move(channel));
  }

  tinygltf::Model model_;
  tinygltf::Animation animation_;
};

/// Stands in the model for what happened in the run, which may be long: no other text of the model reads like this, as
/// quotes within strings are escaped.
constexpr const char* kRecordsKey = "records";
constexpr std::string_view kRecordsMark = "\"records\":\"\"";

/// The bodies with what moves them.
void add_bodies(ModelBuilder& builder, int root, const RecordedMotion& motion, const RunResult& result,
                const RunRecords& records, const detail::Extent& extent, double fps) {
  const World& world = motion.world();
  std::map<std::string, std::vector<double>> impact_times;  // of each body
  records.each_impact([&](const Impact& impact) { impact_times[impact.body].push_back(impact.elapsed); });

  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const World::Body& body = world.bodies[i];
    std::vector<double> jumps = std::move(impact_times[body.name]);
    records.each_event([&](const EventRecord& event) { jumps.push_back(event.elapsed); });
    ranges::sort(jumps, {}, [](double t) { return std::abs(t); });
    const AnimationKeys keys = detail::animation_keys(motion, result, body, jumps, fps);
    const LinearColor color = body.color ? linear(*body.color) : kBodyColors[i % kBodyColors.size()];
    const int node =
        builder.add_node(body.name, builder.add_mesh(body.name, detail::body_mesh(body, extent), color), root);
    if (!body.points.empty()) {
      const int mesh = builder.add_mesh(body.name + ".points", detail::point_mesh(body, extent), color);
      for (const World::Point& point : body.points)
        builder.node(builder.add_node(body.name + "." + point.name, mesh, node)).translation = {
            point.p_B.x(), point.p_B.y(), point.p_B.z()};
    }
    if (keys.times.empty()) continue;
    builder.place(node, {keys.positions.front().cast<double>(), Quaternion(keys.rotations.front().cast<double>())});
    builder.add_animation(node, keys, body.rotation.has_value());
  }
}

}  // namespace

void write_gltf(const RecordedMotion& motion, const RunResult& result, const RunRecords& records, double fps,
                const std::function<void(std::string_view)>& write) {
  const detail::Extent extent = detail::extent(motion);
  ModelBuilder builder;
  const int root = builder.add_root("world");
  // z up to y up: -90 degrees about x, (x, y, z) -> (x, z, -y)
  constexpr double kHalfSqrt2 = std::numbers::sqrt2 / 2.0;
  if (motion.world().up == UpAxis::z) builder.node(root).rotation = {-kHalfSqrt2, 0.0, 0.0, kHalfSqrt2};
  builder.node(root).extras =
      Value(Value::Object{{"start_time", Value(result.start_time)}, {kRecordsKey, Value(std::string())}});
  add_bodies(builder, root, motion, result, records, extent, fps);
  for (const World::Obstacle& obstacle : motion.world().obstacles) {
    const LinearColor color = obstacle.color ? linear(*obstacle.color) : kObstacleColor;
    const detail::GltfMesh surface = detail::obstacle_mesh(obstacle.shape, extent);
    if (surface.positions.empty()) continue;  // of a room, the first wall shows all
    const int node = builder.add_node(obstacle.name, builder.add_mesh(obstacle.name, surface, color), root);
    const detail::Pose start = detail::obstacle_pose(obstacle.shape, extent);
    builder.place(node, start);
    if (obstacle.drive && result.elapsed != 0.0)
      builder.add_animation(node, detail::animation_keys(result, obstacle, start, fps), obstacle.drive->turns);
  }
  detail::write_with_records(std::move(builder).write(result.title), kRecordsMark, records, write);
}

std::string gltf_binary(const RecordedMotion& motion, const RunResult& result, double fps) {
  std::string bytes;
  write_gltf(motion, result, ResultRecords(result), fps, [&](std::string_view part) { bytes += part; });
  return bytes;
}

}  // namespace trajet
