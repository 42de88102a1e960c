#pragma once

namespace trajet {

/// Which crossings of zero an event is about.
enum class CrossingDirection { rising, falling, any };

}  // namespace trajet
