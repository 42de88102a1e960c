#include "trajet/text/name.hpp"

#include <span>

#include "trajet/portable.hpp"

namespace trajet {

namespace {

/// A character of a UTF-8 text; of length 0 where the text ends or is no UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

Character first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return {};
  char32_t code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xc0U) != 0x80U) return {};
    code = code << 6U | (byte & 0x3fU);
  }
  return {code, length};
}

struct CodeRange {
  char32_t first;
  char32_t last;
};

constexpr CodeRange kLetters[] = {{'A', 'Z'},       {'_', '_'},       {'a', 'z'},        {0xc0, 0xd6},
                                  {0xd8, 0xf6},     {0xf8, 0x2ff},    {0x370, 0x37d},    {0x37f, 0x1fff},
                                  {0x200c, 0x200d}, {0x20a0, 0x218f}, {0x2c00, 0x2fef},  {0x3001, 0xd7ff},
                                  {0xf900, 0xfdcf}, {0xfdf0, 0xfffd}, {0x10000, 0xeffff}};
constexpr CodeRange kFollowing[] = {{'0', '9'}, {0x300, 0x36f}, {0x203f, 0x2040}};

bool is_in(std::span<const CodeRange> table, char32_t code) {
  return ranges::any_of(table, [code](const CodeRange& r) { return r.first <= code && code <= r.last; });
}

}  // namespace

std::size_t letter_length(std::string_view text) {
  const Character c = first_character(text);
  return is_in(kLetters, c.code) ? c.length : 0;
}

std::size_t name_character_length(std::string_view text) {
  const Character c = first_character(text);
  return is_in(kLetters, c.code) || is_in(kFollowing, c.code) ? c.length : 0;
}

std::size_t name_length(std::string_view text) {
  std::size_t length = letter_length(text);
  if (length == 0) return 0;
  while (const std::size_t next = name_character_length(text.substr(length))) length += next;
  return length;
}

}  // namespace trajet
