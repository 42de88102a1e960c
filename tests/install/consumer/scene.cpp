// A scene from a text, run, and its report.
#include <trajet/io/report_json.hpp>
#include <trajet/io/scene_file.hpp>
#include <trajet/sim/run.hpp>

#include <cstdio>

int main() {
  const trajet::Scene scene = trajet::parse_scene(R"(
[time]
end = "10 s"
[[body]]
name = "stone"
position = [0, 0, "45 m"]
acceleration = [0, 0, -10]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)",
                                                  "stone.toml");
  const trajet::RunResult result = trajet::run(scene);
  const bool reported = trajet::report_json(result).find("\"with\": \"ground\"") != std::string::npos;
  // 45 m = g t^2 / 2 with g = 10 m/s^2: t = 3 s, exactly.
  std::printf("%zu impact at %g s, %s\n", result.impacts.size(), result.end_time,
              reported ? "reported" : "not reported");
}
