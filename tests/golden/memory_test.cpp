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

/// A ball between two walls that hits one of them a hundred times a second.
std::string room(int impacts) {
  const std::string wall = "[[obstacle]]\nshape = \"plane\"\non_hit = \"bounce\"\nrestitution = 1\n";
  const std::string seconds = std::to_string(impacts / 100.0);
  return "[time]\nend = " + seconds + "\nsample = " + seconds +
         "\n[[body]]\nname = \"ball\"\nposition = [0.5, 0, 0]\nvelocity = [100, 0, 0]\n" + wall +
         "name = \"left\"\npoint = [0, 0, 0]\nnormal = [1, 0, 0]\n" + wall +
         "name = \"right\"\npoint = [1, 0, 0]\nnormal = [-1, 0, 0]\n";
}

TEST(Memory, DoesNotGrowWithTheImpactsOfAReportOrAPage) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps what is freed";
#endif
  const TemporaryFolder folder;
  const auto peak = [&](int impacts, const std::string& option, const std::string& file) {
    std::vector<std::string> words{"run", folder.write("scene.toml", room(impacts)), "--quiet"};
    if (!option.empty()) words.insert(words.end(), {option, folder.file(file)});
    const ProgramResult result = run_trajet(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return kKilobyte * static_cast<double>(result.peak_kilobytes);
  };
  constexpr int kFew = 10'000, kMany = 60'000;
  const auto per_impact = [&](const std::string& option, const std::string& file) {
    return (peak(kMany, option, file) - peak(kFew, option, file)) / (kMany - kFew);
  };
  // bytes; measured: 0 to 5. An impact in memory has 400, with the motion after it 800
  EXPECT_LT(per_impact("", ""), 30.0);
  EXPECT_LT(per_impact("--json", "report.json"), 30.0);
  constexpr int kNoPage = 5;
  const std::string page = folder.file("page.html");
  if (run_trajet({"run", folder.write("short.toml", room(100)), "--quiet", "--html", page}).exit_code != kNoPage) {
    EXPECT_LT(per_impact("--html", "page.html"), 30.0);
  }
  EXPECT_LT(per_impact("--glb", "motion.glb"), 330.0);  // its keys; measured: 220
}

}  // namespace
}  // namespace trajet
