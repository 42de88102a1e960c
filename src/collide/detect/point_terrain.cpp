#include <cassert>

#include "tightened_gap.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/landscape.hpp"

namespace trajet {

namespace {

/// The height of a point above the ground, times `factor`.
struct TerrainGap {
  const Landscape& landscape;
  detail::Coordinate x, y, z;
  double factor = 1.0;

  TerrainGap(const Landscape& of, const PointPath& path)
      : landscape(of),
        x(path, of.R_WB().col(0), of.p_WB()),
        y(path, of.R_WB().col(1), of.p_WB()),
        z(path, of.R_WB().col(2), of.p_WB()) {}

  template <class Enclose>
  IntervalJet gap(const Enclose& enclose) const {
    return factor * (enclose(z) - landscape.height(enclose(x), enclose(y)));
  }
};

}  // namespace

ContactResult first_contact_with(const Terrain& terrain, const MovingBall& point, const ContactMemory& memory) {
  assert(point.radius == 0.0);
  TerrainGap surface(*terrain.landscape, point.path);
  const detail::TightenedGap gap(surface, point, detail::handled_tolerance(memory, point));
  constexpr bool kIsSolid = true;
  const auto contact =
      detail::search_gap(gap, point, kIsSolid, memory, detail::is_handled(memory, point), [](double) { return true; });
  // Near the ground the distance is the height times the cosine of the slope.
  if (contact.status != ContactStatus::separated && contact.status != ContactStatus::unresolved) {
    const GroundPlace below = ground_below(terrain, point.path.value(contact.tau));
    surface.factor = below.normal.dot(terrain.landscape->R_WB().col(2));
  }
  return detail::report(gap, contact, point, kIsSolid, [&](const Vector3& position) {
    const GroundPlace below = ground_below(terrain, position);
    return detail::SurfacePoint{below.point, below.normal};
  });
}

}  // namespace trajet
