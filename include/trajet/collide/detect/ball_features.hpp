#pragma once

#include "trajet/collide/detect/contact.hpp"
#include "trajet/geom/shapes.hpp"

namespace trajet {

/// What touches where a ball (of radius 0: a point) is in contact with a shape at a point of its surface, where the
/// normal of the contact is `normal`.
TouchedFeatures features_of_ball(double radius, const Shape& shape, const Vector3& point, const Vector3& normal);

}  // namespace trajet
