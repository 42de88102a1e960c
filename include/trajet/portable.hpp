#pragma once

#include <algorithm>
#include <bit>

/// What C++20 has and not every standard library that trajet is to be built with: one place where it can be replaced.
namespace trajet {

using std::bit_cast;

namespace ranges {
using std::ranges::all_of;
using std::ranges::any_of;
using std::ranges::binary_search;
using std::ranges::copy;
using std::ranges::count;
using std::ranges::count_if;
using std::ranges::equal;
using std::ranges::find;
using std::ranges::find_if;
using std::ranges::lower_bound;
using std::ranges::max;
using std::ranges::max_element;
using std::ranges::none_of;
using std::ranges::partition_point;
using std::ranges::set_union;
using std::ranges::sort;
using std::ranges::stable_sort;
using std::ranges::transform;
}  // namespace ranges

/// The number type of more digits than double: 64 bits of mantissa on x86, 113 where it is made of software.
using Extended = long double;

}  // namespace trajet
