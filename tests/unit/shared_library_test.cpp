#include "src/io/shared_library.hpp"

#include <gtest/gtest.h>

#include "trajet/error.hpp"

namespace trajet::detail {
namespace {

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no FileError";
}

TEST(SharedLibrary, FindsFunctionsOfALibrary) {
  const SharedLibrary math("libm.so.6", "computes");
  EXPECT_EQ(math.function<double(double)>("floor")(2.5), 2.0);
}

TEST(SharedLibrary, SaysWhichLibraryIsMissingAndWhatItIsFor) {
  const std::string message = message_of([] { SharedLibrary("libnowhere.so.1", "reads mesh files"); });
  EXPECT_NE(message.find("the library that reads mesh files"), std::string::npos) << message;
  EXPECT_NE(message.find("libnowhere.so.1"), std::string::npos) << message;
}

TEST(SharedLibrary, SaysWhichFunctionIsMissing) {
  const SharedLibrary math("libm.so.6", "computes");
  const std::string message = message_of([&] { math.function<void()>("no_such_function"); });
  EXPECT_NE(message.find("libm.so.6 has no function 'no_such_function'"), std::string::npos) << message;
}

}  // namespace
}  // namespace trajet::detail
