// The colours of a scene: from text to what is drawn.

#include "trajet/scene/rgb_color.hpp"

#include <gtest/gtest.h>

#include "scene_run.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/viz/page.hpp"

namespace trajet {
namespace {

TEST(RgbColor, IsFoundByDigitsOrByName) {
  EXPECT_EQ(find_color("#12aBfF"), (RgbColor{0x12, 0xab, 0xff}));
  EXPECT_EQ(find_color("teal"), (RgbColor{0, 128, 128}));
  EXPECT_EQ(find_color("Orange"), (RgbColor{255, 165, 0}));
  for (const char* text : {"", "#", "#fff", "#12345", "#1234567", "#12345g", "# 12345", "12345", "redd"})
    EXPECT_EQ(find_color(text), std::nullopt) << text;
  EXPECT_EQ(color_text({0x0a, 0xff, 0}), "#0aff00");
  EXPECT_NE(unknown_color("gray ").find("did you mean 'gray'?"), std::string::npos);
}

TEST(RgbColor, IsInTheDataOfThePageWhereTheSceneHasOne) {
  if (!page_unavailable().empty()) GTEST_SKIP() << page_unavailable();
  MotionRecord motion;
  test::run_text(
      "[time]\nend = 1\n[[body]]\nname = \"a\"\ncolor = \"#FF8000\"\n[[body]]\nname = \"b\"\n[[obstacle]]\nname = "
      "\"o\"\n"
      "shape = \"sphere\"\ncenter = [5, 0, 0]\nradius = 1\ncolor = \"navy\"\n",
      &motion);
  const std::string page = page_html({{motion, [](const auto& write) { write("{}"); }}});
  EXPECT_NE(page.find("\"color\":\"#ff8000\""), std::string::npos);
  EXPECT_NE(page.find("\"color\":\"#000080\""), std::string::npos);
  const std::size_t first = page.find("\"color\":\"#"), second = page.find("\"color\":\"#", first + 1);
  EXPECT_EQ(page.find("\"color\":\"#", second + 1), std::string::npos) << "body b has none";
}

}  // namespace
}  // namespace trajet
