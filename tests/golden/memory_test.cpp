// How much memory the program needs, counted by the system.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "program.hpp"

namespace trajet {
namespace {

constexpr double kKilobyte = 1024.0;

/// A hilly ground of triangles, and a point that falls on it.
std::string triangles(int count) {
  std::string text = "[time]\nend = 1\n[[body]]\nname = \"p\"\nposition = [0.3, 0.4, 2]\nacceleration = [0, 0, -9.8]\n";
  const auto corner = [](int i, int j) {
    return "[" + std::to_string(0.1 * i) + ", " + std::to_string(0.1 * j) + ", " + std::to_string(0.01 * (i * j % 7)) +
           "]";
  };
  for (int k = 0; k < count; ++k) {
    const int i = k % 100, j = k / 100;
    text += "[[obstacle]]\nname = \"t" + std::to_string(k) + "\"\nshape = \"triangle\"\npoints = [" + corner(i, j) +
            ", " + corner(i + 1, j) + ", " + corner(i, j + 1) + "]\n";
  }
  return text;
}

TEST(Memory, OfATriangleIsAboutAKilobyte) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what is freed";
#endif
  const TemporaryFolder folder;
  const auto peak = [&](int count) {
    const ProgramResult result = run_trajet({"run", folder.write("scene.toml", triangles(count)), "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return kKilobyte * static_cast<double>(result.peak_kilobytes);
  };
  constexpr int kFew = 10'000, kMany = 40'000;
  EXPECT_LT((peak(kMany) - peak(kFew)) / (kMany - kFew), 1200.0);  // bytes; measured: 975
}

}  // namespace
}  // namespace trajet
