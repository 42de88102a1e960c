#include "trajet/law/lookup_table.hpp"

#include <gtest/gtest.h>
#include <math.h>  // the isnan of Boost's pchip

#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>

#include "trajet/io/scene_file.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/math/pack.hpp"
#include "trajet/math/series.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

struct Points {
  std::vector<double> x, y;
};

Points random_points(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> width(0.1, 2.0), height(-3.0, 3.0);
  Points points;
  double x = -4.0;
  for (int i = 0; i < n; ++i) {
    points.x.push_back(x += width(random));
    points.y.push_back(i % 5 == 3 ? points.y.back() : height(random));  // level pieces too
  }
  return points;
}

TEST(LookupTable, agrees_with_boost_pchip) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Points points = random_points(random, 4 + repeat % 7);
    const LookupTable table(points.x, points.y);
    auto x = points.x, y = points.y;
    const boost::math::interpolators::pchip<std::vector<double>> reference(std::move(x), std::move(y));
    // Boost takes the first secant as the slope at the ends, so that only inner cells are the same function.
    for (double u = points.x[1]; u < points.x[points.x.size() - 2]; u += 0.01) {
      EXPECT_NEAR(table(u), reference(u), 1e-13) << u;  // values up to 3, a few operations each
    }
  }
}

TEST(LookupTable, goes_through_its_points_and_keeps_between_them) {
  std::mt19937 random(2);
  const Points points = random_points(random, 12);
  const LookupTable table(points.x, points.y);
  for (std::size_t i = 0; i < points.x.size(); ++i) EXPECT_NEAR(table(points.x[i]), points.y[i], 1e-14);
  for (std::size_t i = 0; i + 1 < points.x.size(); ++i) {
    const auto [low, high] = std::minmax(points.y[i], points.y[i + 1]);
    for (double f = 0.0; f <= 1.0; f += 0.05) {
      const double y = table(points.x[i] + f * (points.x[i + 1] - points.x[i]));
      EXPECT_GE(y, low - 1e-13);
      EXPECT_LE(y, high + 1e-13);
    }
  }
}

TEST(LookupTable, parabola_slope_at_the_ends_and_straight_line) {
  // y = x^2 on three points: the end slopes of the parabola through them, 2 x
  const LookupTable parabola({1.0, 2.0, 4.0}, {1.0, 4.0, 16.0});
  EXPECT_NEAR(parabola.cell(0).c1, 2.0, 1e-14);
  // where the parabola would overshoot, at most three times the first secant; where it would turn back, level
  EXPECT_EQ(LookupTable({0.0, 1.0, 2.0}, {0.0, 1.0, -9.0}).cell(0).c1, 3.0);
  EXPECT_EQ(LookupTable({0.0, 1.0, 2.0}, {0.0, 1.0, 9.0}).cell(0).c1, 0.0);
  const LookupTable line({1.0, 3.0}, {2.0, 8.0});
  EXPECT_EQ(line(2.0), 5.0);
}

TEST(LookupTable, is_nan_outside_and_fails_on_bad_points) {
  const LookupTable table({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0});
  EXPECT_TRUE(std::isnan(table(-1e-9)));
  EXPECT_TRUE(std::isnan(table(2.0 + 1e-9)));
  EXPECT_TRUE(std::isnan(table(std::nan(""))));
  EXPECT_EQ(table(2.0), 0.0);
  EXPECT_THROW(LookupTable({1.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(LookupTable({1.0, 1.0}, {1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(LookupTable({1.0, 2.0}, {1.0}), std::invalid_argument);
}

TEST(LookupTable, every_number_type_agrees_with_double) {
  std::mt19937 random(3);
  const Points points = random_points(random, 9);
  const LookupTable table(points.x, points.y);
  std::uniform_real_distribution<double> inside(points.x.front(), points.x.back());
  for (int repeat = 0; repeat < 200; ++repeat) {
    alignas(64) std::array<double, kPackSize> lanes;
    for (double& lane : lanes) lane = inside(random);
    const Pack pack = table(Pack::load_unaligned(lanes.data()));
    for (std::size_t i = 0; i < lanes.size(); ++i) EXPECT_NEAR(pack.get(i), table(lanes[i]), 1e-14);

    // the derivatives of the series against differences: error of central differences h^2 f''' / 6 with |f'''| < 1e4
    const double x = lanes[0], h = 1e-5;
    const auto series = table(Series<double, 2>::variable(x));
    EXPECT_NEAR(series[0], table(x), 1e-14);
    const int cell = table.find_cell(x);
    if (x - h > table.cell(cell).begin && x + h < table.cell_end(cell)) {
      EXPECT_NEAR(series[1], (table(x + h) - table(x - h)) / (2.0 * h), 1e-6);
    }

    const double y = inside(random);
    const Interval enclosure = table(Interval(std::min(x, y), std::max(x, y)));
    for (double f = 0.0; f <= 1.0; f += 0.1) {
      const double value = table(x + f * (y - x));
      EXPECT_LE(enclosure.lower(), value);
      EXPECT_GE(enclosure.upper(), value);
    }
  }
}

class TableFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("trajet_table_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& text) const {
    const std::string path = (folder_ / "data.csv").string();
    std::ofstream(path) << text;
    return path;
  }

  /// A scene beside the file that looks it up.
  Scene scene_with(const std::string& table) const {
    return parse_scene("[time]\nend = 1\n[[state]]\nname = \"s\"\nvalue = 0\nrate = \"table('" + table + "', t)\"\n",
                       (folder_ / "scene.toml").string());
  }
  LookupTable read(const std::string& text) const {
    write(text);
    return *scene_with("data.csv").tables.at("data.csv");
  }

  /// The place of the error in the file, or line 0 if it is read without one.
  SourceLocation error_in(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.where();
    }
    return {};
  }

  std::filesystem::path folder_;
};

TEST_F(TableFile, reads_columns_with_and_without_a_title) {
  for (const char* text : {"time,thrust\n0,1\n1,3\n", "0;1\n1;3", "0 1\r\n1   3\r\n\r\n", "0,\t1\n\n1, 3\n"}) {
    EXPECT_EQ(read(text)(0.5), 2.0) << text;
  }
}

TEST_F(TableFile, errors_point_into_the_file) {
  EXPECT_EQ(error_in("0,1\n1,2\n1,3\n").line, 3);
  EXPECT_EQ(error_in("x,y\n0,1\n1\n").line, 3);
  EXPECT_EQ(error_in("0,1\nx,y\n1,2").line, 2);
  EXPECT_EQ(error_in("0,1,2\n1,2,3").line, 1);
  EXPECT_EQ(error_in("0,nan\n1,2").line, 1);
  EXPECT_EQ(error_in("x,y\n0,1\n").line, 2);
  EXPECT_NE(error_in("").file, "");
}

TEST_F(TableFile, that_is_missing_is_told_where_it_is_named) {
  try {
    scene_with("none.csv");
    ADD_FAILURE();
  } catch (const FileError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("scene.toml:6:9: error: cannot read the table '"), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with("none.csv': there is no such file")) << message;
  }
}

TEST(Tables, come_with_the_scene_as_data) {
  const Expression formula("2*table('drag', x)");
  Symbols symbols;
  symbols.set_constant("x", 0.5);
  EXPECT_THROW(evaluate_scalar(formula, symbols), InputError);
  symbols.set_table("drag", std::make_shared<const LookupTable>(std::vector{0.0, 2.0}, std::vector{0.0, 4.0}));
  EXPECT_EQ(evaluate_scalar(formula, Symbols(&symbols)), 2.0);

  Scene scene;
  scene.time.end = 1.0;
  scene.states.push_back({"s", 0.0, "table('drag', 2*t)"});
  EXPECT_THROW(make_world(scene), InputError);
  scene.tables["drag"] = std::make_shared<const LookupTable>(std::vector{0.0, 2.0}, std::vector{0.0, 4.0});
  const World world = make_world(scene);
  double rate = 0.0, state = 0.0;
  Evaluator<double> evaluate(world.groups[0].law);
  evaluate(0.25, &state, &rate);
  EXPECT_EQ(rate, 1.0);
}

}  // namespace
}  // namespace trajet
