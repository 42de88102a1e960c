#pragma once

#include "trajet/scene/scene.hpp"

namespace trajet::detail {

/// Checks the names that a scene gives, from a file or from C++: their form, that none is given twice or has a meaning
/// of its own, and that `exact` and `set` speak of things that exist. Throws InputError at the name.
void check_names(const Scene& scene);

}  // namespace trajet::detail
