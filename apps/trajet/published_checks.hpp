#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trajet {

/// A number that somebody else has published, and the scene that leads to it.
struct PublishedCheck {
  std::string_view source;
  std::string_view problem;  ///< its name there
  std::string scene;         ///< as a scene file
  std::string_view observe;  ///< `final NAME`: ball.z, ball.vx or a state; `impact K`: time of the K-th one; `rest`: of
                             ///< the first rest; `nodes METHOD N`: the largest error over the nodes of N steps
  double value;              ///< as published, SI
  double tolerance;          ///< absolute: half a unit of the last digit that was published, and our own rounding
};

/// All of them, by source.
std::span<const PublishedCheck> published_checks();

}  // namespace trajet
