#include "output_names.hpp"

#include <filesystem>
#include <system_error>

#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"

namespace trajet {

namespace {

namespace fs = std::filesystem;

bool is_written(const NamedOutput& output) { return !output.path.empty() && output.path != "-"; }

/// Whether two names are those of one file, which may not exist yet. A name that cannot be looked up is nobody else's:
/// opening it tells what is wrong with it.
bool is_same_file(const fs::path& a, const fs::path& b) {
  if (is_stream(a.string())) return false;
  std::error_code unknown;
  if (fs::exists(a, unknown) && fs::exists(b, unknown)) return fs::equivalent(a, b, unknown);
  const fs::path place = fs::weakly_canonical(a, unknown);
  return !unknown && place == fs::weakly_canonical(b, unknown);
}

void check_ending(const NamedOutput& output) {
  if (output.endings.empty() || is_stream(output.path)) return;
  for (const std::string_view ending : output.endings)
    if (output.path.size() > ending.size() && output.path.ends_with(ending)) return;
  std::string expected(output.endings.front());
  for (std::size_t i = 1; i < output.endings.size(); ++i) expected += " or " + std::string(output.endings[i]);
  throw InputError({std::string(output.option)},
                   "a file name that ends in " + expected + " expected, got '" + output.path + "'");
}

}  // namespace

void check_outputs(const std::string& scene, const std::vector<NamedOutput>& outputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (!is_written(*output)) continue;
    const SourceLocation where{std::string(output->option)};
    if (is_same_file(output->path, scene))
      throw InputError(where, "'" + output->path + "' is the scene, which would be lost: name another file");
    for (auto other = outputs.begin(); other != output; ++other)
      if (is_written(*other) && is_same_file(output->path, other->path))
        throw InputError(where, "'" + output->path + "' is the file of " + std::string(other->option) +
                                    " already: name another one");
  }
  for (const NamedOutput& output : outputs)
    if (is_written(output)) check_ending(output);
}

}  // namespace trajet
