#include "lexer.hpp"

#include <algorithm>

#include "trajet/text/decimal_number.hpp"
#include "trajet/text/name.hpp"

namespace trajet::detail {
namespace {

// The <cctype> functions depend on the locale and on the sign of char.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The character at `offset` for a message: whole where it is UTF-8, as a number where it cannot be printed.
std::string quote_character(std::string_view text, std::size_t offset) {
  const auto byte = static_cast<unsigned char>(text[offset]);
  if (byte < 0x20 || byte == 0x7f) return "the control character " + std::to_string(byte);
  std::size_t end = offset + 1;
  while (byte >= 0xc0 && end < text.size() && end < offset + 4 &&
         (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    ++end;
  if (byte >= 0x80 && end == offset + 1) return "the byte " + std::to_string(byte);
  return "'" + std::string(text.substr(offset, end - offset)) + "'";
}

struct ForeignOperator {
  std::string_view spelling;
  std::string_view ours;
};

/// What other languages write, longest first.
constexpr ForeignOperator kForeignOperators[] = {{"**", "^"},  {"&&", "and"}, {"||", "or"}, {"<>", "!="}, {"!", "not"},
                                                 {"&", "and"}, {"=", "=="},   {";", ","},   {"{", "("},   {"}", ")"},
                                                 {"−", "-"},   {"–", "-"},    {"·", "*"},   {"×", "*"},   {"÷", "/"},
                                                 {"²", "^2"},  {"³", "^3"},   {"≤", "<="},  {"≥", ">="},  {"≠", "!="}};

/// What to write for a character that other notations have.
std::string_view remedy(std::string_view rest) {
  if (rest.starts_with('|')) return ": write abs(x), of a vector norm(v); 'or' joins conditions";
  if (rest.starts_with('?') || rest.starts_with(':')) return ": write where(c, a, b) for c ? a : b";
  if (rest.starts_with("°")) return ": angles are in radians, write x*pi/180 or give a parameter in deg";
  return "";
}

constexpr std::string_view kSymbols[] = {"<=", ">=", "==", "!=", "+", "-", "*", "/",
                                         "^",  "<",  ">",  "(",  ")", "[", "]", ","};

}  // namespace

Lexer::Lexer(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names)
    : text_(text), where_(where), dashed_names_(dashed_names) {
  if (where_.line == 0) where_.line = where_.column = 1;
}

void Lexer::move(std::size_t length) {
  for (const std::size_t end = position_ + length; position_ < end; ++position_) {
    ++where_.column;
    if (text_[position_] == '\n') {
      ++where_.line;
      where_.column = 1;
    }
  }
}

Token Lexer::take(TokenKind kind, std::size_t length) {
  const Token token{kind, text_.substr(position_, length), where_.line, where_.column};
  move(length);
  return token;
}

Token Lexer::next() {
  while (position_ < text_.size() && is_blank(text_[position_])) move(1);
  if (position_ == text_.size()) return take(TokenKind::end, 0);
  const char c = text_[position_];
  const bool point_then_digit = c == '.' && position_ + 1 < text_.size() && is_digit(text_[position_ + 1]);
  if (is_digit(c) || point_then_digit) return number();
  if (letter_length(text_.substr(position_)) > 0) return name();
  if (c == '"' || c == '\'') return quoted_string();
  return symbol();
}

Token Lexer::number() {
  const std::string_view rest = text_.substr(position_);
  const DecimalNumber number = leading_number(rest).value();  // it begins with a digit
  if (number.is_out_of_range) {
    const std::string digits(rest.substr(0, std::min<std::size_t>(number.length, 40)));
    fail("the number " + digits + " is outside the range of double precision");
  }
  Token token = take(TokenKind::number, number.length);
  token.value = {number.value, number.exact};
  return token;
}

std::size_t Lexer::dotted_length(std::size_t begin) const {
  // NAME(.NAME)*; a point that no letter follows is not part of it.
  std::size_t end = begin;
  while (true) {
    end += name_length(text_.substr(end));
    if (end == text_.size() || text_[end] != '.' || letter_length(text_.substr(end + 1)) == 0) return end - begin;
    ++end;
  }
}

Token Lexer::name() {
  const std::string_view rest = text_.substr(position_);
  std::size_t dashed = 0;
  for (const std::string& candidate : dashed_names_) {
    const bool matches = rest.starts_with(candidate) && name_character_length(rest.substr(candidate.size())) == 0;
    if (matches) dashed = std::max(dashed, candidate.size());
  }
  const std::string_view behind = rest.substr(dashed);
  const bool has_part = dashed > 0 && behind.starts_with('.') && letter_length(behind.substr(1)) > 0;
  const std::size_t dashed_length = has_part ? dashed + 1 + dotted_length(position_ + dashed + 1) : dashed;
  return take(TokenKind::name, std::max(dashed_length, dotted_length(position_)));
}

Token Lexer::quoted_string() {
  const std::size_t end = text_.find(text_[position_], position_ + 1);
  if (end == std::string_view::npos) fail("the closing quote is missing");
  Token token = take(TokenKind::string, end + 1 - position_);
  token.text = token.text.substr(1, token.text.size() - 2);
  return token;
}

Token Lexer::symbol() {
  const std::string_view rest = text_.substr(position_);
  for (const ForeignOperator& foreign : kForeignOperators) {
    const bool is_ours = rest.starts_with("==") || rest.starts_with("!=");
    if (!is_ours && rest.starts_with(foreign.spelling)) {
      fail("'" + std::string(foreign.spelling) + "' is not an operator here; did you mean '" +
           std::string(foreign.ours) + "'?");
    }
  }
  for (const std::string_view symbol : kSymbols) {
    if (rest.starts_with(symbol)) return take(TokenKind::symbol, symbol.size());
  }
  fail(quote_character(text_, position_) + " is not allowed in an expression" + std::string(remedy(rest)));
}

}  // namespace trajet::detail
