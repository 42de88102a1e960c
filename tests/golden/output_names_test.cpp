// No output is written over the scene or over another output.

#include <gtest/gtest.h>

#include "program.hpp"

namespace trajet {
namespace {

const std::string kScene = "[time]\nend = 1\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\n";

TEST(Outputs, NoneIsWrittenOverTheSceneOrAnother) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", kScene);
  const std::string earlier = folder.write("earlier", "kept");
  const std::string link = folder.file("link"), other_name = folder.file("./s.toml");
  const std::string fresh = folder.file("new.svg"), same_fresh = folder.file("none/../new.svg");
  std::filesystem::create_symlink(earlier, link);
  struct Case {
    std::vector<std::string> arguments;
    std::string option;
  };
  const Case cases[] = {
      {{"run", scene, "--csv", scene}, "--csv"},
      {{"run", scene, "--json", other_name}, "--json"},
      {{"run", scene, "--html", scene}, "--html"},
      {{"run", scene, "--json", earlier, "--csv", earlier}, "--csv"},
      {{"run", scene, "--json", earlier, "--csv", link}, "--csv"},
      {{"run", scene, "--json", earlier, "--glb", earlier}, "--glb"},
      {{"run", scene, "--json", fresh, "--csv", fresh}, "--csv"},
      {{"run", scene, "--json", fresh, "--plot", same_fresh}, "--plot"},
      {{"compare", scene, "--csv", scene}, "--csv"},
      {{"compare", scene, "--json", earlier, "--csv", earlier}, "--csv"},
      {{"view", scene, "--no-open", "--out", scene}, "--out"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_trajet(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(c.arguments) << result.err;
    EXPECT_TRUE(result.err.starts_with(c.option + ": error: '")) << result.err;
    EXPECT_EQ(read_text(scene), kScene);
    EXPECT_EQ(read_text(earlier), "kept");
    EXPECT_FALSE(std::filesystem::exists(fresh));
  }
}

TEST(Outputs, DevicesTakeAnyNumber) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", kScene);
  const ProgramResult result = run_trajet({"run", scene, "--json", "/dev/null", "--csv", "/dev/null"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace trajet
