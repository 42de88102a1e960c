// Runs a libFuzzer target without libFuzzer: over every file given, and over mutations of each that are the same in
// every run. A crash, a sanitizer's finding or an escaped exception is the failure.
//
//   replay FILE...

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr int kMutationsPerFile = 300;

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// One to four edits, each of which changes, drops, doubles or moves some bytes.
std::string mutated(std::string text, std::mt19937& random) {
  for (unsigned edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
    const std::size_t at = random() % text.size();
    const std::size_t length = 1 + random() % 16;
    switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.insert(random() % text.size(), text.substr(at, length));
        break;
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("replay: no input files\n", stderr);
    return 1;
  }
  std::mt19937 random(20160913);  // any fixed number: the inputs are the same in every run
  run("");
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    if (!file) {
      std::fprintf(stderr, "replay: cannot read %s\n", argv[i]);
      return 1;
    }
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    run(text);
    for (int k = 0; k < kMutationsPerFile; ++k) run(mutated(text, random));
  }
  std::printf("%d files, %d mutations of each\n", argc - 1, kMutationsPerFile);
  return 0;
}
