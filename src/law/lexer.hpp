#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trajet/error.hpp"
#include "trajet/math/extended_constant.hpp"

namespace trajet::detail {

enum class TokenKind { number, name, string, symbol, end };

/// A word of a formula. `text` views the formula; of a string, without its quotes.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;
  int line = 1;
  int column = 1;
  ExtendedConstant value{};  ///< number
};

/// Cuts a formula into tokens.
class Lexer {
 public:
  /// `dashed_names`: names that contain `-`; where the text has one, it is one name and not a subtraction.
  Lexer(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names);

  /// The next token; `end` at the end, again and again. Throws InputError on a character that starts no token.
  Token next();

  /// Where the token begins in the user's file.
  SourceLocation location(const Token& token) const { return {where_.file, token.line, token.column}; }

 private:
  /// Makes a token of the next `length` characters and moves behind it.
  Token take(TokenKind kind, std::size_t length);
  void move(std::size_t length);
  [[noreturn]] void fail(const std::string& message) const { throw InputError(where_, message); }

  Token number();
  Token name();
  Token quoted_string();
  Token symbol();
  std::size_t dotted_length(std::size_t begin) const;

  std::string_view text_;
  SourceLocation where_;  // of the character at position_
  std::span<const std::string> dashed_names_;
  std::size_t position_ = 0;
};

}  // namespace trajet::detail
