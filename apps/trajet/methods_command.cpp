#include <fmt/format.h>

#include "commands.hpp"
#include "terminal.hpp"
#include "text_table.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet {

namespace {

const char* step_control(StepControl control) {
  switch (control) {
    case StepControl::fixed:
      return "given";
    case StepControl::adaptive:
      return "adaptive";
    case StepControl::subdivided:
      return "divided";
  }
  return "";
}

}  // namespace

int methods_command() {
  const auto order = [](int value) { return value == 0 ? std::string("tolerance") : fmt::format("{}", value); };
  constexpr const char* kRow = "{:<21} {:<22} {:<10} {:<10} {:<10} {}";
  constexpr std::size_t kTextColumn = 22;
  const auto wrapped = [width = text_width(stdout)](const std::string& line) { return wrap(line, kTextColumn, width); };
  std::string text = wrapped(fmt::format(kRow, "name", "aliases", "order", "dense", "step", "known as"));
  for (const MethodInfo& method : methods()) {
    const char* control = step_control(method.control);
    text += wrapped(fmt::format(kRow, method.name, fmt::format("{}", fmt::join(method.aliases, ", ")),
                                order(method.order), order(method.dense_order), control, method.known_as));
    text += wrapped(fmt::format("{:<21} {}", "", method.summary));
  }
  constexpr const char* kOrientationRow = "{:<21} {:<18} {:<10} {}";
  text += "\n" + wrapped(fmt::format(kOrientationRow, "orientation", "aliases", "numbers", "known as"));
  for (const OrientationInfo& info : orientation_ways()) {
    text += wrapped(fmt::format(kOrientationRow, info.name, fmt::format("{}", fmt::join(info.aliases, ", ")), info.size,
                                info.known_as));
    text += wrapped(fmt::format("{:<21} {}", "", info.summary));
  }
  OutputFile out("-");
  out.write(text);
  out.finish();
  return kDone;
}

}  // namespace trajet
