#pragma once

namespace trajet {

/// What the coefficient of restitution e measures in an impact with friction, and so what ends it: the work of the
/// normal impulse in compression comes back times e^2 (Stronge), that impulse times e (Poisson), or the normal speed
/// times e (Newton). Without friction they are one.
enum class RestitutionOf { work, impulse, speed };

}  // namespace trajet
