#include "shared_library.hpp"

#include <dlfcn.h>

#include "trajet/error.hpp"

namespace trajet::detail {

SharedLibrary::SharedLibrary(const char* file_name, const std::string& purpose)
    : file_name_(file_name), handle_(dlopen(file_name, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) throw FileError("cannot load the library that " + purpose + ": " + dlerror());
}

void* SharedLibrary::address(const char* name) const {
  void* const address = dlsym(handle_, name);
  if (address == nullptr) throw FileError("the library " + file_name_ + " has no function '" + name + "'");
  return address;
}

}  // namespace trajet::detail
