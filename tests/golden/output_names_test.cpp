// No output is written over the scene, another output or a file of another kind; what is replaced is replaced as a
// whole.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "program.hpp"
#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"

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

TEST(Outputs, ANameEndsAsThoseOfItsKindDo) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", kScene), victim = folder.write("victim.toml", "kept");
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const Case cases[] = {
      {{"run", "--json", victim, scene}, "--json: error: a file name that ends in .json expected, got '" + victim},
      {{"run", "--csv", victim, scene}, "--csv: error: a file name that ends in .csv expected, got '" + victim},
      {{"run", "--glb", victim, scene}, "--glb: error: a file name that ends in .glb expected, got '" + victim},
      {{"run", "--html", victim, scene},
       "--html: error: a file name that ends in .html or .htm expected, got '" + victim},
      {{"view", "--no-open", "--out", victim, scene}, "--out: error: a file name that ends in .html or .htm expected"},
      {{"compare", "--json", victim, scene}, "--json: error: a file name that ends in .json expected, got '" + victim},
      {{"compare", "--csv", victim, scene}, "--csv: error: a file name that ends in .csv expected, got '" + victim},
      {{"run", scene, "--json", folder.file("r.csv")}, "--json: error: a file name that ends in .json expected"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_trajet(c.arguments);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(c.arguments) << result.err;
    EXPECT_TRUE(result.err.starts_with(c.message)) << result.err;
    EXPECT_EQ(read_text(victim), "kept");
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("r.csv")));
}

TEST(Outputs, StandardOutputUnderItsNameOfAFileIsNoFileToReplace) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.toml", kScene);
  const ProgramResult result = run_trajet({"run", scene, "--quiet", "--json", "/dev/stdout"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("{")) << result.out;
}

std::size_t files_in(const std::string& folder) {
  const std::filesystem::directory_iterator files(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(OutputFile, ReplacesAFileWhenItIsFinishedAndNotBefore) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.csv", "old"), link = folder.file("link.csv");
  std::filesystem::create_symlink(old, link);
  ASSERT_EQ(chmod(old.c_str(), 0640), 0);
  { OutputFile(link).write("never finished"); }
  EXPECT_EQ(read_text(old), "old");
  EXPECT_EQ(files_in(folder.file("")), 2U);
  {
    OutputFile file(link);
    file.write("new");
    EXPECT_EQ(read_text(old), "old");
    file.finish();
  }
  EXPECT_EQ(read_text(old), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(files_in(folder.file("")), 2U);
  struct stat status = {};
  ASSERT_EQ(stat(old.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

/// How a child that writes over the file ended: its exit code, or 128 + signal.
template <typename Write>
int write_in_child(const Write& write) {
  const pid_t child = fork();
  if (child == 0) {
    write();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(OutputFile, AKilledProgramOrAFullDiskLeaveTheOldFile) {
  const TemporaryFolder folder;
  const std::string old = folder.write("old.csv", "old");
  const std::string text(1U << 20U, 'x');
  const auto killed = [&] {
    OutputFile file(old);
    file.write(text);
    raise(SIGKILL);
  };
  EXPECT_EQ(write_in_child(killed), 128 + SIGKILL);
  EXPECT_EQ(read_text(old), "old");
  const std::size_t before = files_in(folder.file(""));
  const auto out_of_room = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most = {4096, 4096};
    setrlimit(RLIMIT_FSIZE, &most);
    try {
      OutputFile file(old);
      file.write(text);
      file.finish();
    } catch (const FileError&) {
      _exit(5);
    }
  };
  EXPECT_EQ(write_in_child(out_of_room), 5);
  EXPECT_EQ(read_text(old), "old");
  EXPECT_EQ(files_in(folder.file("")), before);
}

}  // namespace
}  // namespace trajet
