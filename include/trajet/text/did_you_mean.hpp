#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trajet {

/// `; did you mean 'NAME'?` with the nearest of the known names, or nothing where none is near.
///
/// Near: at most a third of the characters differ by insertion, removal, replacement or exchange of neighbours.
/// A difference of case counts as nothing. The first of equally near names wins.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

}  // namespace trajet
