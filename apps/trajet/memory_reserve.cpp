#include "memory_reserve.hpp"

#include "commands.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

namespace trajet {
namespace {

constexpr std::size_t kReserve = std::size_t{8} << 20U;  // bytes: reports are written part by part

void* reserve = nullptr;
bool is_out = false;

/// What `operator new` asks where it has found no memory: it tries again if this returns.
void give_back() {
  is_out = true;
  if (reserve == nullptr) throw std::bad_alloc();
  std::free(std::exchange(reserve, nullptr));
}

/// A library that lets no exception out of a function of its own ends the program there; what ends it is told all the
/// same. Standard error is not buffered: that needs no memory.
void end_without_memory() {
  if (!is_out) std::abort();
  constexpr std::string_view kMessage = "error: memory has run out\n";
  std::fwrite(kMessage.data(), 1, kMessage.size(), stderr);
  std::_Exit(kNumbersFailed);
}

}  // namespace

void set_memory_aside() {
  std::set_terminate(end_without_memory);
  if (reserve == nullptr) reserve = std::malloc(kReserve);
  is_out = reserve == nullptr;
  std::set_new_handler(give_back);
}

bool is_out_of_memory() { return is_out; }

}  // namespace trajet
