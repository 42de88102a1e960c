#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "trajet/geom/revolution_distance.hpp"
#include "trajet/geom/rounded_solid.hpp"

namespace trajet {
namespace {

constexpr double kPi = std::numbers::pi;

/// Calls f(x, weight) for the nodes of Gauss and Legendre's quadrature between a and b.
template <unsigned Nodes, class F>
void quadrature(double a, double b, F&& f) {
  using Gauss = boost::math::quadrature::gauss<double, Nodes>;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    const double x = Gauss::abscissa()[i], weight = half * Gauss::weights()[i];
    f(middle + half * x, weight);
    if (x != 0.0) f(middle - half * x, weight);
  }
}

constexpr unsigned kSmooth = 20;  // for trigonometric functions over at most a half circle
constexpr unsigned kCubic = 3;    // exact up to the fifth degree

/// Volume integrals of 1, x and x x^T, as a sum over points.
struct Moments {
  double volume = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  void add(double weight, const Vector3& p) {
    volume += weight;
    first += weight * p;
    second += weight * p * p.transpose();
  }
  void add(const VolumeProperties& solid) {
    volume += solid.volume;
    first += solid.volume * solid.center;
    second += 0.5 * solid.inertia.trace() * Matrix3::Identity() - solid.inertia +
              solid.volume * solid.center * solid.center.transpose();
  }
  VolumeProperties properties() const {
    const Vector3 center = first / volume;
    const Matrix3 about_center = second - volume * center * center.transpose();
    return {volume, center, about_center.trace() * Matrix3::Identity() - about_center};
  }
};

/// What grows out of a polytope: prisms on its faces, wedges of cylinders on its edges, sectors of balls at its
/// corners.
class GrownHull {
 public:
  GrownHull(const TriangleMesh& core, double growth) : core_(core), growth_(growth) {
    for (std::size_t i = 0; i < core.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) triangle_of_edge_[{at(i, k), at(i, k + 1)}] = i;
    for (std::size_t i = 0; i < core.triangles.size(); ++i) {
      const Vector3 a = corner(at(i, 0)), b = corner(at(i, 1)), c = corner(at(i, 2));
      normals_.push_back((b - a).cross(c - a).normalized());
    }
  }

  VolumeProperties properties() {
    moments_.add(mesh_properties(core_));
    for (std::size_t i = 0; i < core_.triangles.size(); ++i) add_prism(i);
    std::map<int, std::size_t> triangle_at;
    for (const auto& [edge, triangle] : triangle_of_edge_) {
      if (edge.first < edge.second) add_wedge(edge, triangle);
      triangle_at.try_emplace(edge.first, triangle);
    }
    for (const auto& [vertex, triangle] : triangle_at) add_sector(vertex, triangle);
    return moments_.properties();
  }

 private:
  int at(std::size_t triangle, std::size_t k) const { return core_.triangles[triangle][k % 3]; }
  const Vector3& corner(int vertex) const { return core_.vertices[static_cast<std::size_t>(vertex)]; }

  void add_prism(std::size_t i) {
    const Vector3 a = corner(at(i, 0)), b = corner(at(i, 1)), c = corner(at(i, 2));
    const double area = 0.5 * (b - a).cross(c - a).norm();
    // the middles of the sides: exact up to the second degree
    for (const Vector3& middle : {Vector3(0.5 * (a + b)), Vector3(0.5 * (b + c)), Vector3(0.5 * (c + a))})
      quadrature<kCubic>(0.0, growth_,
                         [&](double h, double weight) { moments_.add(weight * area / 3.0, middle + h * normals_[i]); });
  }

  void add_wedge(const std::pair<int, int>& edge, std::size_t triangle) {
    const Vector3 &n = normals_[triangle], &m = normals_[triangle_of_edge_.at({edge.second, edge.first})];
    const Vector3 &from = corner(edge.first), &to = corner(edge.second);
    const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
    if (angle == 0.0) return;
    const Vector3 aside = (m - n.dot(m) * n).normalized();
    const double length = (to - from).norm();
    quadrature<kSmooth>(0.0, angle, [&](double phi, double phi_weight) {
      const Vector3 direction = std::cos(phi) * n + std::sin(phi) * aside;
      quadrature<kCubic>(0.0, growth_, [&](double r, double r_weight) {
        quadrature<kCubic>(0.0, 1.0, [&](double s, double s_weight) {
          moments_.add(phi_weight * r_weight * r * s_weight * length, from + s * (to - from) + r * direction);
        });
      });
    });
  }

  /// The normals of the triangles around a corner, one after the other, span a polygon on the sphere.
  void add_sector(int vertex, std::size_t first) {
    std::vector<Vector3> around;
    std::size_t triangle = first;
    do {
      around.push_back(normals_[triangle]);
      const auto& corners = core_.triangles[triangle];
      const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
      triangle = triangle_of_edge_.at({vertex, corners[(k + 2) % 3]});
    } while (triangle != first);
    for (std::size_t i = 2; i < around.size(); ++i) add_cone(vertex, around[0], around[i - 1], around[i]);
  }

  /// The sector over a triangle on the sphere; a wide one in four.
  void add_cone(int vertex, const Vector3& a, const Vector3& b, const Vector3& c) {
    constexpr double kWide = 0.5;  // cosine
    if (std::min({a.dot(b), b.dot(c), c.dot(a)}) < kWide) {
      const Vector3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      add_cone(vertex, a, ab, ca);
      add_cone(vertex, ab, b, bc);
      add_cone(vertex, ca, bc, c);
      return add_cone(vertex, ab, bc, ca);
    }
    // p = a + u (b - a) + u v (c - b), the solid angle det(a, b, c) / |p|^3 u du dv
    const double determinant = std::abs(a.dot(b.cross(c)));
    quadrature<kSmooth>(0.0, 1.0, [&](double u, double u_weight) {
      quadrature<kSmooth>(0.0, 1.0, [&](double v, double v_weight) {
        const Vector3 p = a + u * (b - a) + u * v * (c - b);
        const double norm = p.norm(), angle = determinant / (norm * norm * norm) * u * u_weight * v_weight;
        quadrature<kCubic>(0.0, growth_, [&](double r, double r_weight) {
          moments_.add(angle * r * r * r_weight, corner(vertex) + r / norm * p);
        });
      });
    });
  }

  const TriangleMesh& core_;
  double growth_;
  std::map<std::pair<int, int>, std::size_t> triangle_of_edge_;  // each edge in the direction of its triangle
  std::vector<Vector3> normals_;
  Moments moments_;
};

}  // namespace

VolumeProperties grown_hull_properties(const TriangleMesh& core, double growth) {
  return GrownHull(core, growth).properties();
}

VolumeProperties grown_profile_properties(const std::vector<Eigen::Vector2d>& profile, double growth) {
  // slices across the axis: pi rho^2 dz, of which the moment about the axis is pi/2 rho^4 dz
  double volume = 0.0, first = 0.0, along = 0.0, about_axis = 0.0;
  const auto add = [&](double rho, double z, double dz) {
    const double slice = kPi * rho * rho * dz;
    volume += slice;
    first += slice * z;
    along += slice * z * z;
    about_axis += 0.5 * slice * rho * rho;
  };
  double before = -0.5 * kPi;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool is_last = i + 1 == profile.size();
    const Eigen::Vector2d normal =
        is_last ? Eigen::Vector2d(0.0, 1.0) : detail::ProfileEdge(profile[i], profile[i + 1]).normal;
    const double behind = is_last ? 0.5 * kPi : std::atan2(normal.y(), normal.x());
    quadrature<kSmooth>(before, behind, [&](double phi, double weight) {
      add(profile[i].x() + growth * std::cos(phi), profile[i].y() + growth * std::sin(phi),
          growth * std::cos(phi) * weight);
    });
    before = behind;
    if (is_last) break;
    const Eigen::Vector2d from = profile[i] + growth * normal, way = profile[i + 1] - profile[i];
    quadrature<kCubic>(0.0, 1.0, [&](double s, double weight) {
      const Eigen::Vector2d p = from + s * way;
      add(p.x(), p.y(), way.y() * weight);
    });
  }
  const double center = first / volume;
  const double across = 0.5 * about_axis + along - volume * center * center;
  return {volume, Vector3(0.0, 0.0, center), Vector3(across, across, about_axis).asDiagonal()};
}

}  // namespace trajet
