#include "trajet/io/gltf.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "gltf_keys.hpp"
#include "gltf_shapes.hpp"
#include "trajet/error.hpp"
#include "trajet/io/names.hpp"
#include "trajet/version.hpp"

namespace trajet {

namespace {

using detail::GltfMesh;
using detail::Pose;
using detail::Tint;
using Value = tinygltf::Value;

Value value(const Vector3& v) { return Value(Value::Array{Value(v.x()), Value(v.y()), Value(v.z())}); }

Value value(const std::vector<Impact>& impacts) {
  Value::Array array;
  for (const Impact& impact : impacts)
    array.emplace_back(Value::Object{{"time", Value(impact.time)},
                                     {"body", Value(impact.body)},
                                     {"with", Value(impact.with)},
                                     {"kind", Value(std::string(name(impact.kind)))},
                                     {"point", value(impact.point)},
                                     {"normal", value(impact.normal)},
                                     {"position", value(impact.position)},
                                     {"velocity_before", value(impact.velocity_before)},
                                     {"velocity_after", value(impact.velocity_after)}});
  return Value(std::move(array));
}

/// Colours of bodies, linear: those of [OkabeIto2008].
constexpr std::array<std::array<double, 3>, 6> kBodyColors{{{0.0, 0.168, 0.445},
                                                            {0.791, 0.347, 0.0},
                                                            {0.604, 0.191, 0.386},
                                                            {0.0, 0.342, 0.171},
                                                            {0.665, 0.112, 0.0},
                                                            {0.093, 0.456, 0.815}}};
constexpr std::array<double, 3> kObstacleColor{0.35, 0.38, 0.42};
constexpr std::array<double, 3> kLightColor{0.9, 0.9, 0.87};
constexpr std::array<double, 3> kDarkColor{0.012, 0.012, 0.016};

std::array<double, 3> tinted(const std::array<double, 3>& own, Tint tint) {
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

  int add_mesh(const std::string& name, const GltfMesh& data, const std::array<double, 3>& color) {
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

  void add_animation(int node, const std::map<float, Pose>& keys, bool turns) {
    std::vector<Eigen::Matrix<float, 1, 1>> times;
    std::vector<Eigen::Vector3f> translations;
    std::vector<Eigen::Vector4f> rotations;
    for (const auto& [time, pose] : keys) {
      times.emplace_back(time);
      translations.push_back(pose.position.cast<float>());
      rotations.push_back(pose.q_WB.coeffs().cast<float>());  // x, y, z, w: as glTF has them
    }
    const int input = add_floats(times, 0);
    add_channel(node, "translation", input, add_floats(translations, 0));
    if (turns) add_channel(node, "rotation", input, add_floats(rotations, 0));
  }

  std::string write(const std::string& title) {
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

  int add_material(const std::string& name, const std::array<double, 3>& color) {
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

}  // namespace

std::string gltf_binary(const MotionRecord& motion, const RunResult& result, double fps) {
  const World& world = motion.world();
  const detail::Extent extent = detail::extent(motion);
  ModelBuilder builder;
  const int root = builder.add_root("world");
  // z up to y up: -90 degrees about x, (x, y, z) -> (x, z, -y)
  constexpr double kHalfSqrt2 = std::numbers::sqrt2 / 2.0;
  builder.node(root).rotation = {-kHalfSqrt2, 0.0, 0.0, kHalfSqrt2};
  builder.node(root).extras =
      Value(Value::Object{{"start_time", Value(result.start_time)}, {"impacts", value(result.impacts)}});

  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const World::Body& body = world.bodies[i];
    const auto keys = detail::animation_keys(motion, result, body, fps);
    const auto& color = kBodyColors[i % kBodyColors.size()];
    const int node =
        builder.add_node(body.name, builder.add_mesh(body.name, detail::body_mesh(body, extent), color), root);
    if (!body.points.empty()) {
      const int mesh = builder.add_mesh(body.name + ".points", detail::point_mesh(body, extent), color);
      for (const World::Point& point : body.points)
        builder.node(builder.add_node(body.name + "." + point.name, mesh, node)).translation = {
            point.p_B.x(), point.p_B.y(), point.p_B.z()};
    }
    if (keys.empty()) continue;
    const Pose& first = keys.begin()->second;
    builder.node(node).translation = {first.position.x(), first.position.y(), first.position.z()};
    if (!first.q_WB.isApprox(Quaternion::Identity()))
      builder.node(node).rotation = {first.q_WB.x(), first.q_WB.y(), first.q_WB.z(), first.q_WB.w()};
    builder.add_animation(node, keys, body.rotation.has_value());
  }
  for (const World::Obstacle& obstacle : world.obstacles)
    builder.add_node(obstacle.name,
                     builder.add_mesh(obstacle.name, detail::obstacle_mesh(obstacle.shape, extent), kObstacleColor),
                     root);
  return builder.write(result.title);
}

}  // namespace trajet
