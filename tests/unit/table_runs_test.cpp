#include "src/io/table_runs.hpp"

#include <gtest/gtest.h>

#include "scene_run.hpp"
#include "trajet/error.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

using detail::cut_table_runs;
using detail::TableRuns;

std::string text_of(const std::string& text, const detail::TextStretch& run) {
  return text.substr(run.begin, run.size);
}

TEST(TableRuns, AreCutOutAndTheRestKeepsItsLines) {
  const std::string text =
      "a = 1\n"
      "[[body]]\nx = 2\n"
      "[[it]]\nn = 1\n"
      "[it.in]\nb = 3\n"
      " [[ it ]] # second\nn = 2\n"
      "[[it]]\nn = 3\n"
      "[time]\nend = 1\n"
      "[[it]]\nn = 4";
  const TableRuns cut = cut_table_runs(text, "it", 2);
  EXPECT_EQ(cut.table_count, 4U);
  ASSERT_EQ(cut.runs.size(), 3U);
  EXPECT_EQ(text_of(text, cut.runs[0]), "[[it]]\nn = 1\n[it.in]\nb = 3\n [[ it ]] # second\nn = 2\n");
  EXPECT_EQ(cut.runs[0].first_line, 4);
  EXPECT_EQ(text_of(text, cut.runs[1]), "[[it]]\nn = 3\n");
  EXPECT_EQ(cut.runs[1].first_line, 10);
  EXPECT_EQ(text_of(text, cut.runs[2]), "[[it]]\nn = 4");
  EXPECT_EQ(cut.runs[2].first_line, 14);
  EXPECT_EQ(cut.rest, "a = 1\n[[body]]\nx = 2\n\n\n\n\n\n\n\n\n[time]\nend = 1\n\n");
}

TEST(TableRuns, WhatOnlyLooksLikeAHeaderIsNone) {
  for (const std::string value :
       {"\"\"\"\n[[it]]\n\\\"\"\"\n[[it]]\n\"\"\"", "'''\n[[it]]\n'''", "[\n[[1]],\n[[it]]\n]", "[ # ]\n[[it]]\n]",
        "[ \"]\", ']'\n, [\n[it]\n]]", "\"\"\"\"\n[[it]]\n\"\"\"\"\""}) {
    const std::string text = "[a]\nx = " + value + "\n[[it]]\ny = 1\n";
    const TableRuns cut = cut_table_runs(text, "it", 10);
    EXPECT_EQ(cut.table_count, 1U) << value;
    ASSERT_EQ(cut.runs.size(), 1U) << value;
    EXPECT_EQ(text_of(text, cut.runs[0]), "[[it]]\ny = 1\n");
  }
  for (const std::string header : {"[it]", "[[item]]", "[[\"it\"]]", "[it.in]", "[[it.in]]", "# [[it]]"})
    EXPECT_EQ(cut_table_runs(header + "\n", "it", 10).table_count, 0U) << header;
}

/// A scene with so many obstacles, each on four lines from the fifth on, that they are read run by run. The last line
/// of the one with the number `wrong` is another one.
std::string scene_of(int count, int wrong = -1, const std::string& line = {}) {
  std::string text = "[time]\nend = 1\n[[body]]\nname = \"b\"\n";
  for (int i = 0; i < count; ++i)
    text +=
        "[[obstacle]]\nname = \"t" + std::to_string(i) + "\"\nshape = \"triangle\"\n" +
        (i == wrong ? line : "points = [[" + std::to_string(i) + ", 0.1, -0.0], [1.5, 2, 1e3], [0, \"2 cm\", -1e-3]]") +
        "\n";
  return text;
}

TEST(TableRuns, ManyObstaclesAreReadLikeFew) {
  constexpr int kMany = 1000, kFew = 100;
  const Scene many = parse_scene(scene_of(kMany), "many.toml"), few = parse_scene(scene_of(kFew), "many.toml");
  ASSERT_EQ(many.obstacles.size(), static_cast<std::size_t>(kMany));
  for (std::size_t i = 0; i < few.obstacles.size(); ++i) {
    const ObstacleDefinition &a = many.obstacles[i], &b = few.obstacles[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.where.line, b.where.line);
    const auto &triangle = std::get<TriangleShape>(a.shape), &same = std::get<TriangleShape>(b.shape);
    EXPECT_EQ(triangle.a.text(), same.a.text());
    EXPECT_EQ(triangle.a.where().column, same.a.where().column);
    EXPECT_EQ(triangle.c.where().line, same.c.where().line);
    EXPECT_EQ(triangle.c.text(), same.c.text());
  }
  const auto& last = many.obstacles.back();
  EXPECT_EQ(last.name, "t999");
  EXPECT_EQ(last.where.line, 4 + 4 * 999 + 2);
  EXPECT_EQ(last.where.file.str(), "many.toml");
  EXPECT_EQ(std::get<TriangleShape>(last.shape).a.where().line, 4 + 4 * 1000);
  EXPECT_EQ(std::get<TriangleShape>(last.shape).a.where().column, 12);
}

std::string fault_of(const std::string& text) {
  try {
    make_world(parse_scene(text, "many.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(TableRuns, FaultsInManyObstaclesPointAtTheirLines) {
  const auto begins = [](const std::string& text, const std::string& head) { return text.substr(0, head.size()); };
  const std::string place = "many.toml:" + std::to_string(4 + 4 * 778) + ":";
  for (const std::string line :
       {"points = [[0, 0, 0], [1, 0, 0], [2, 0]]", "points = [[0, 0, 0], [1, 0, 0], [0, 1, \"q\"]]", "point = 3",
        "points = [[0, 0, 0], [1, 0, 0], [0, 1, \"1 kg\"]]", "points = [[0, 0, 0] [1, 0, 0], [0, 1, 1]]"})
    EXPECT_EQ(begins(fault_of(scene_of(1000, 777, line)), place), place) << line;
  // what follows an array that does not end is of the array
  EXPECT_EQ(begins(fault_of(scene_of(1000, 777, "points = [")), "many.toml:31"), "many.toml:31");
  EXPECT_NE(fault_of(scene_of(1000) + "[obstacle]\nname = \"x\"\n"), "");
  EXPECT_NE(fault_of("obstacle = []\n" + scene_of(1000)), "");
}

TEST(TableRuns, AQuotedKeyIsTheSameKey) {
  const std::string text =
      scene_of(1000) + "[[\"obstacle\"]]\nname = \"q\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\n" + "radius = 1\n";
  EXPECT_EQ(parse_scene(text, "many.toml").obstacles.size(), 1001U);
}

}  // namespace
}  // namespace trajet
