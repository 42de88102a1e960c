#include "trajet/io/run_spool.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "scene_run.hpp"
#include "temporary_folder.hpp"
#include "trajet/io/gltf.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/viz/page.hpp"

namespace trajet {
namespace {

std::string all_of(const Spool& spool, std::size_t stream, std::size_t part) {
  Spool::Reader reader(spool, stream);
  std::string text, bytes(part, ' ');
  while (reader.read(bytes)) text += bytes;
  return text;
}

TEST(Spool, GivesBackEachStreamWhateverLiesInItsFile) {
  const TemporaryFolder folder;
  constexpr std::size_t kStreams = 5;
  for (const bool is_beside : {true, false}) {
    Spool spool(is_beside ? folder.file("report.json") : "-", kStreams);
    std::vector<std::string> expected(kStreams);
    std::mt19937 random(1);
    while (spool.file_size() < 3 * Spool::kMemory) {
      const std::size_t stream = random() % (kStreams - 1);  // the last one stays empty
      const std::string bytes(8 * (random() % 5000), static_cast<char>('a' + random() % 26));
      spool.append(stream, bytes);
      expected[stream] += bytes;
    }
    for (std::size_t stream = 0; stream < kStreams; ++stream)
      EXPECT_EQ(all_of(spool, stream, 8), expected[stream]) << stream;
    // it has no name, so nothing is left of it whatever ends the program
    EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
  }
}

TEST(Spool, OfLittleHasNoFile) {
  Spool spool("/nowhere/report.json", 1);
  spool.append(0, std::string(Spool::kMemory / 2, 'x'));
  EXPECT_EQ(spool.file_size(), 0u);
  EXPECT_EQ(all_of(spool, 0, 1), std::string(Spool::kMemory / 2, 'x'));
}

/// A box that tumbles, whose impacts tell of their features; a block whose law sticks and slips; a point with an event.
/// Many groups, many pieces.
const char* const kTumble = R"toml(
[time]
end = 3
[method]
name = "rk4"
step = 0.001
[[body]]
name = "box"
shape = "box"
size = [0.2, 0.3, 0.4]
mass = 1
position = [0, 0, 1]
angular_velocity = [1, 2, 3]
acceleration = [0, 0, -9.81]
[[body]]
name = "block"
position = [3, 0, 1]
velocity = [1, 0, 0]
acceleration = "[-sign(vx), 0, 0]"
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.8
[[event]]
name = "apex"
when = "box.vz"
)toml";

TEST(RunSpool, OfARunGivesTheSameReportPageAndAnimationByteForByte) {
  const World world = make_world(parse_scene(kTumble, "test.toml"));
  MotionRecord memory;
  const RunResult kept = run(world, &memory);
  ASSERT_GT(kept.impacts.size(), 3u);
  RecordSpool records("-");
  MotionSpool motion("-", world);
  ObserverList observers({&records, &motion});
  RunResult spooled = run(world, &observers);
  EXPECT_TRUE(spooled.impacts.empty());
  spooled.statistics.wall_seconds = kept.statistics.wall_seconds;

  const auto text = [](const auto& write_all) {
    std::string all;
    write_all([&](std::string_view part) { all += part; });
    return all;
  };
  const std::string report = text([&](const auto& write) { write_report_json(spooled, records, write); });
  EXPECT_NE(report.find("\"features\""), std::string::npos);
  EXPECT_NE(report.find("\"law\""), std::string::npos);
  EXPECT_EQ(report, report_json(kept));
  EXPECT_EQ(text([&](const auto& write) { write_gltf(motion, spooled, records, 60.0, write); }),
            gltf_binary(memory, kept, 60.0));
  if (!page_unavailable().empty()) GTEST_SKIP() << page_unavailable();
  const auto tell = [&](const auto& write) { write(report); };
  EXPECT_TRUE(page_html({{motion, tell}}) == page_html({{memory, tell}}));
}

}  // namespace
}  // namespace trajet
