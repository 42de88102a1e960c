#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace trajet {

/// Powers of the base units m, kg, s, A, K, mol, cd, rad.
struct Dimension {
  static constexpr std::size_t kBaseUnits = 8;
  std::array<std::int16_t, kBaseUnits> powers{};
  bool operator==(const Dimension&) const = default;
};

inline constexpr Dimension kDimensionless{};
inline constexpr Dimension kLength{{1}};
inline constexpr Dimension kMass{{0, 1}};
inline constexpr Dimension kTime{{0, 0, 1}};
inline constexpr Dimension kSpeed{{1, 0, -1}};
inline constexpr Dimension kAcceleration{{1, 0, -2}};
inline constexpr Dimension kForce{{1, 1, -2}};
inline constexpr Dimension kAngle{{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr Dimension kFrequency{{0, 0, -1}};
inline constexpr Dimension kAngularVelocity{{0, 0, -1, 0, 0, 0, 0, 1}};
inline constexpr Dimension kAngularAcceleration{{0, 0, -2, 0, 0, 0, 0, 1}};
inline constexpr Dimension kDensity{{-3, 1}};
inline constexpr Dimension kInertia{{2, 1}};
inline constexpr Dimension kTorque{{2, 1, -2}};

/// Name and SI unit for messages: `length [m]`, `[m^2 kg^3]` where the dimension has no common name.
std::string describe(const Dimension& dimension);

/// Whether a quantity of one dimension may stand for one of the other: equal but for radians, which are numbers in SI.
bool interchangeable(const Dimension& a, const Dimension& b);

/// That of a b^power.
Dimension product(const Dimension& a, const Dimension& b, int power = 1);

/// That of the numerator-th power of the denominator-th root of `a`; nothing where it has no whole powers.
std::optional<Dimension> power_of(const Dimension& a, int numerator, int denominator);

}  // namespace trajet
