#include "trajet/io/report_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace trajet {
namespace {

RunResult result_with_impacts(std::size_t count) {
  RunResult result;
  result.status = RunStatus::failed;
  result.failure = "the numbers ended";
  Impact impact;
  impact.body = "ball";
  impact.with = "wall";
  impact.point = impact.normal = impact.position = impact.velocity_before = impact.velocity_after = impact.impulse =
      Vector3(0.1, -1.0 / 3.0, 1e-300);
  for (std::size_t i = 0; i < count; ++i) {
    impact.time = 0.1 * static_cast<double>(i);
    result.impacts.push_back(impact);
  }
  return result;
}

TEST(ReportJson, IsHandedOnInPartsThatDoNotGrowWithTheImpacts) {
  // 64 KiB is where a part is handed on; one impact more, 1 KiB at most, is in it then
  constexpr std::size_t kLargestPart = (64 + 1) * 1024;
  for (const std::size_t count : {0u, 1u, 100u, 1000u, 20000u}) {
    std::size_t largest = 0;
    std::string text;
    write_report_json(result_with_impacts(count), [&](std::string_view part) {
      largest = std::max(largest, part.size());
      text += part;
    });
    EXPECT_LE(largest, kLargestPart) << count << " impacts";
    const auto json = nlohmann::json::parse(text);
    ASSERT_EQ(json["impacts"].size(), count);
    if (count > 0) {
      EXPECT_EQ(json["impacts"][count - 1]["time"], 0.1 * static_cast<double>(count - 1));
      EXPECT_EQ(json["impacts"][count - 1]["impulse"], nlohmann::json({0.1, -1.0 / 3.0, 1e-300}));
    }
  }
}

TEST(ReportJson, SaysEachThingOnce) {
  const std::string text = report_json(result_with_impacts(1));
  for (const auto& [key, value] : nlohmann::json::parse(text).items()) {
    const std::string member = "\n  \"" + key + "\":";
    EXPECT_EQ(text.find(member), text.rfind(member)) << key;
  }
}

TEST(ReportJson, OfAFailedRunIsAWholeDocument) {
  const auto json = nlohmann::json::parse(report_json(result_with_impacts(3)));
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["failure"], "the numbers ended");
  EXPECT_EQ(json["events"], nlohmann::json::array());
  EXPECT_TRUE(json["statistics"].is_object());
}

}  // namespace
}  // namespace trajet
