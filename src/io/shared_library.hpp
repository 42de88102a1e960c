#pragma once

#include <string>

namespace trajet::detail {

/// A library that is loaded while the program runs, by those runs that need it, and stays loaded: a large library costs
/// more to load than most scenes cost to run.
class SharedLibrary {
 public:
  /// `file_name` as the dynamic loader looks for it. Throws FileError, which says for what purpose the library is
  /// needed.
  SharedLibrary(const char* file_name, const std::string& purpose);

  /// The function of this name, of the type of its declaration: `function<decltype(declared)>("declared")`. Throws
  /// FileError if the library has none.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string file_name_;
  void* handle_;
};

}  // namespace trajet::detail
