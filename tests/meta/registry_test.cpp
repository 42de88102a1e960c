#include "trajet/ode/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace trajet {
namespace {

/// A file name cannot hold the slash of a name such as rk4-3/8: its page has a dash there.
std::string page_name(std::string_view method) {
  std::string name(method);
  std::ranges::replace(name, '/', '-');
  return name + ".md";
}

std::string read_page(std::string_view method) {
  std::ifstream page(std::filesystem::path(TRAJET_SOURCE_DIR) / "docs/methods" / page_name(method));
  return {std::istreambuf_iterator<char>(page), std::istreambuf_iterator<char>()};
}

TEST(Registry, EveryMethodHasAPageThatNamesItsAliases) {
  ASSERT_FALSE(methods().empty());
  for (const MethodInfo& method : methods()) {
    const std::string page = read_page(method.name);
    EXPECT_FALSE(page.empty()) << "docs/methods/" << page_name(method.name) << " is missing";
    EXPECT_TRUE(page.starts_with("# " + std::string(method.name) + "\n")) << page_name(method.name);
    for (const std::string_view alias : method.aliases) {
      EXPECT_NE(page.find(alias), std::string::npos) << page_name(method.name) << " does not name " << alias;
    }
  }
}

TEST(Registry, EveryPageIsOfAMethod) {
  for (const auto& page :
       std::filesystem::directory_iterator(std::filesystem::path(TRAJET_SOURCE_DIR) / "docs/methods")) {
#ifndef TRAJET_WITH_SUNDIALS
    if (page.path().stem() == "adams" || page.path().stem() == "bdf") continue;
#endif
    const auto is_its_page = [&page](const MethodInfo& method) {
      return page_name(method.name) == page.path().filename();
    };
    EXPECT_TRUE(std::ranges::any_of(methods(), is_its_page)) << page.path() << " is of no method";
  }
}

TEST(Registry, NamesAndAliasesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const MethodInfo& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_EQ(find_method(method.name), &method);
    for (const std::string_view alias : method.aliases) {
      EXPECT_TRUE(names.insert(alias).second) << alias;
      EXPECT_EQ(find_method(alias), &method);
    }
  }
  EXPECT_EQ(find_method("no such method"), nullptr);
}

}  // namespace
}  // namespace trajet
