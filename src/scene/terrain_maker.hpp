#pragma once

#include <memory>

#include "trajet/geom/landscape.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/law/symbols.hpp"

namespace trajet {

/// The landscape of a height, a formula of `x` and `y` over the names that `constants` has. Throws InputError.
std::shared_ptr<const Landscape> make_landscape(const Expression& height, const Symbols& constants, const Vector3& p_WB,
                                                const Matrix3& R_WB);

}  // namespace trajet
