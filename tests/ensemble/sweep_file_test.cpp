#include "trajet/io/sweep_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "temporary_folder.hpp"
#include "trajet/ensemble/random_stream.hpp"
#include "trajet/error.hpp"
#include "trajet/io/sweep_csv.hpp"

namespace trajet {
namespace {

const std::string kHeader = "index,a\n";
const std::string kFingerprint = "trajet test sweep";
constexpr int kBlocks = 6;

std::string block(int i) {
  std::string text;
  for (int row = 0; row < 3; ++row) text += std::to_string(3 * i + row) + "," + std::to_string(1.5 * i) + "\n";
  return text;
}

SweepTally tally(int i) {
  return {.count = 3, .failed = static_cast<std::uint64_t>(i % 2), .condition = 1, .hits = {{"wall", 2}}};
}

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void write(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

TEST(SweepFile, GoesOnFromWhereverItWasKilled) {
  const TemporaryFolder folder;
  const std::string path = folder.file("whole.csv");
  {
    SweepFile file(path, kFingerprint, kHeader, false);
    for (int i = 0; i < kBlocks; ++i) file.append(block(i), tally(i));
    // never finished
  }
  const std::string table = read(path), journal = read(path + ".journal");
  std::string whole = kHeader;
  for (int i = 0; i < kBlocks; ++i) whole += block(i);
  ASSERT_EQ(table, whole);
  // killed: each of the two files has been written up to any byte
  for (std::uint64_t k = 0; k < 300; ++k) {
    const std::string copy = folder.file("copy.csv");
    const auto cut = [&](const std::string& text, std::uint32_t stream) {
      return text.substr(0, random_bits(1, k, stream, RandomPurpose::bootstrap) % (text.size() + 1));
    };
    write(copy, cut(table, 0));
    write(copy + ".journal", cut(journal, 1));
    SweepFile file(copy, kFingerprint, kHeader, true);
    const auto found = static_cast<int>(file.found().count / 3);
    EXPECT_EQ(file.found().count % 3, 0U);
    EXPECT_EQ(file.found().condition, static_cast<std::uint64_t>(found));
    const auto wall = file.found().hits.find("wall");
    EXPECT_EQ(wall == file.found().hits.end() ? 0U : wall->second, 2U * static_cast<std::uint64_t>(found));
    std::string lines = kHeader;
    file.each_line([&](std::string_view line) { lines += std::string(line) + "\n"; });
    EXPECT_EQ(lines, whole.substr(0, lines.size()));
    for (int i = found; i < kBlocks; ++i) file.append(block(i), tally(i));
    file.finish();
    ASSERT_EQ(read(copy), whole) << k;
    EXPECT_FALSE(std::filesystem::exists(copy + ".journal"));
  }
}

TEST(SweepFile, DoesNotBelieveATableThatHasChanged) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.csv");
  {
    SweepFile file(path, kFingerprint, kHeader, false);
    for (int i = 0; i < kBlocks; ++i) file.append(block(i), tally(i));
  }
  std::string table = read(path);
  const std::size_t changed = kHeader.size() + block(0).size() + block(1).size() + 2;
  table[changed] = table[changed] == '7' ? '8' : '7';
  write(path, table);
  EXPECT_EQ(SweepFile(path, kFingerprint, kHeader, true).found().count, 6U) << "the two blocks before";
}

TEST(SweepFile, TellsSweepsApart) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.csv");
  { SweepFile(path, kFingerprint, kHeader, false).append(block(0), tally(0)); }
  EXPECT_THROW(SweepFile(path, "another", kHeader, true), FileError);
  EXPECT_THROW(SweepFile(path, kFingerprint, kHeader, false), FileError) << "an unfinished one is not lost by mistake";
  {
    SweepFile file(path, kFingerprint, kHeader, true);
    EXPECT_FALSE(file.is_complete());
    file.finish();
  }
  SweepFile complete(path, kFingerprint, kHeader, true);
  EXPECT_TRUE(complete.is_complete());
  EXPECT_EQ(complete.found().count, 3U);
  EXPECT_THROW(SweepFile(path, kFingerprint, "index,b\n", true), FileError);
  { SweepFile anew(path, kFingerprint, kHeader, false); }
  EXPECT_EQ(read(path), kHeader) << "a complete one is replaced";
}

TEST(SweepCsv, ReadsBackWhatItWrites) {
  const SweepHeader header{{"theta"}, {"norm([a, b])", "he said \"x\"", "hit"}};
  std::string line = csv_line(header);
  EXPECT_EQ(line, "index,theta,\"norm([a, b])\",\"he said \"\"x\"\"\",hit\n");
  line.pop_back();
  EXPECT_EQ(read_csv_header(line, 1), header);
  const SweepRow row{.index = 12, .values = {0.1}, .cells = {1.0 / 3.0, std::monostate(), std::string("wall")}};
  std::string text;
  append_csv_line(row, 3, text);
  EXPECT_EQ(text, "12,0.1,0.3333333333333333,,wall\n");
  text.pop_back();
  const SweepRow back = read_csv_row(text, 1);
  EXPECT_EQ(back.index, row.index);
  EXPECT_EQ(back.values, row.values);
  EXPECT_EQ(back.cells, row.cells);
}

}  // namespace
}  // namespace trajet
