#include <exception>
#include <new>
#include <string>

#include "command_line.hpp"
#include "memory_reserve.hpp"
#include "message.hpp"
#include "trajet/error.hpp"

namespace trajet {
namespace {

/// A fault that was met where memory had run out may be none: readers take what they could not store for wrong.
int tell_of_memory() {
  tell("error: memory has run out\n");
  return kNumbersFailed;
}

int exit_code(const InputError& error) {
  // A fault whose place is an option or the program's name stands in the command line, not in the scene.
  const SourceLocation& place = error.where();
  const bool is_program = place.file.str() == "trajet" && place.line == 0;
  return is_program || place.file.str().starts_with("--") ? kWrongCommandLine : kWrongScene;
}

int run_program(int argc, char** argv) {
  try {
    return CommandLine().run({argv + 1, argv + argc});
  } catch (const InputError& error) {
    if (is_out_of_memory()) return tell_of_memory();
    tell_fault(error.what(), error.where());
    return exit_code(error);
  } catch (const FileError& error) {
    if (is_out_of_memory()) return tell_of_memory();
    if (error.has_place())
      tell("{}\n", error.what());
    else
      tell_error(error.what());
    return kFileFailed;
  } catch (const std::bad_alloc&) {
    return tell_of_memory();
  } catch (const std::exception& error) {
    tell_error(std::string("the program failed: ") + error.what());
    return kNumbersFailed;
  }
}

}  // namespace
}  // namespace trajet

int main(int argc, char** argv) {
  trajet::set_memory_aside();
  trajet::keep_standard_error();
  return trajet::run_program(argc, argv);
}
