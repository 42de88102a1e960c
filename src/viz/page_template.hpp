#pragma once

#include <string_view>

namespace trajet::detail {

/// The page without data, as the build made it of viewer/; empty where it did not.
extern const std::string_view kPageTemplate;
/// Why there is none.
extern const std::string_view kPageMissing;

}  // namespace trajet::detail
