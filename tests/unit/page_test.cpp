#include "trajet/viz/page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene_run.hpp"
#include "trajet/io/report_json.hpp"

namespace trajet {
namespace {

/// A ball between two walls that it hits once a second.
std::string room(int seconds) {
  const std::string wall = "[[obstacle]]\nshape = \"plane\"\non_hit = \"bounce\"\nrestitution = 1\n";
  return "title = \"a </script> \\\"quoted\\\" \\\\ title  with blanks\"\n[time]\nend = " + std::to_string(seconds) +
         "\n[[body]]\nname = \"ball\"\nposition = [0.5, 0, 0]\nvelocity = [1, 0, 0]\n" + wall +
         "name = \"left\"\npoint = [0, 0, 0]\nnormal = [1, 0, 0]\n" + wall +
         "name = \"right\"\npoint = [1, 0, 0]\nnormal = [-1, 0, 0]\n";
}

TEST(Page, IsHandedOnInPartsThatDoNotGrowWithTheRunAndHoldsTheReport) {
  if (!page_unavailable().empty()) GTEST_SKIP() << page_unavailable();
  for (const int seconds : {0, 1, 1000}) {
    MotionRecord motion;
    const RunResult result = test::run_text(room(seconds), &motion);
    ASSERT_EQ(result.impacts.size(), static_cast<std::size_t>(seconds));
    std::string page;
    std::vector<std::size_t> sizes;
    write_page({{motion, [&](const auto& write) { write_report_json(result, write); }}}, {},
               [&](std::string_view part) {
                 page += part;
                 sizes.push_back(part.size());
               });
    // the page's own text stands before and behind the data, which are handed on at 64 KiB; `<` becomes 6 bytes
    ASSERT_GE(sizes.size(), 3u);
    EXPECT_LE(*std::max_element(sizes.begin() + 1, sizes.end() - 1), 64u * 1024 + 6) << seconds;

    constexpr std::string_view kMark = "id=\"trajet-data\">";
    const std::size_t begin = page.find(kMark) + kMark.size();
    const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
    const auto run = nlohmann::ordered_json::parse(data).at("runs").at(0);
    EXPECT_EQ(run.at("report"), nlohmann::ordered_json::parse(report_json(result)));
    // each piece: from, to, t0, one number of six degrees, and at least one coefficient for each component
    EXPECT_GE(run.at("groups").at(0).at("pieces").get<std::string>().size() + 1,
              (seconds == 0 ? 0u : static_cast<std::size_t>(seconds + 1) * 10u * sizeof(double) * 4u / 3u));
  }
}

}  // namespace
}  // namespace trajet
