#include "trajet/ode/registry.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace trajet {
namespace {

std::string read_page(std::string_view method) {
  std::ifstream page(std::filesystem::path(TRAJET_SOURCE_DIR) / "docs/methods" / (std::string(method) + ".md"));
  return {std::istreambuf_iterator<char>(page), std::istreambuf_iterator<char>()};
}

TEST(Registry, EveryMethodHasAPageThatNamesItsAliases) {
  ASSERT_FALSE(methods().empty());
  for (const MethodInfo& method : methods()) {
    const std::string page = read_page(method.name);
    EXPECT_FALSE(page.empty()) << "docs/methods/" << method.name << ".md is missing";
    for (const std::string_view alias : method.aliases) {
      EXPECT_NE(page.find(alias), std::string::npos) << "docs/methods/" << method.name << ".md does not name " << alias;
    }
  }
}

TEST(Registry, EveryPageIsOfAMethod) {
  for (const auto& page : std::filesystem::directory_iterator(std::filesystem::path(TRAJET_SOURCE_DIR) / "docs/methods")) {
    const std::string name = page.path().stem().string();
#ifndef TRAJET_WITH_SUNDIALS
    if (name == "adams" || name == "bdf") continue;
#endif
    const MethodInfo* method = find_method(name);
    EXPECT_TRUE(method != nullptr && method->name == name) << page.path() << " is of no method";
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
