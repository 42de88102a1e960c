#include "memory_reserve.hpp"

#include <cstdlib>
#include <new>
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

}  // namespace

void set_memory_aside() {
  if (reserve == nullptr) reserve = std::malloc(kReserve);
  is_out = reserve == nullptr;
  std::set_new_handler(give_back);
}

bool is_out_of_memory() { return is_out; }

}  // namespace trajet
