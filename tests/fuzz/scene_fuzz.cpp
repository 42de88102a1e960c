// Any text as a scene: it is refused with an error that has a place in the text, or it can be checked and run.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "trajet/io/csv_writer.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/sim/run.hpp"

namespace {

/// Ends runs that a mutated end time, step or sample spacing makes long.
class Limit : public trajet::RunObserver {
 public:
  struct TooManySamples {};

  explicit Limit(trajet::CsvWriter& csv) : csv_(csv) {}
  void sample(const trajet::Sample& sample) override {
    csv_.sample(sample);
    if (++samples_ > 2000) throw TooManySamples();
  }
  bool interrupted(double) override { return ++steps_ > 2000; }

 private:
  trajet::CsvWriter& csv_;
  int samples_ = 0;
  int steps_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static trajet::OutputFile sink("/dev/null");
  try {
    const trajet::Scene scene = trajet::parse_scene(std::string(reinterpret_cast<const char*>(data), size), "scene");
    trajet::check(scene);
    trajet::CsvWriter csv(sink);
    Limit limit(csv);
    trajet::report_json(trajet::run(scene, &limit));
  } catch (const trajet::InputError& error) {
    if (error.where().line < 1) {
      std::fprintf(stderr, "an error without a place: %s\n", error.what());
      std::abort();
    }
  } catch (const trajet::FileError&) {  // a table that is not there
  } catch (const Limit::TooManySamples&) {
  }
  return 0;
}
