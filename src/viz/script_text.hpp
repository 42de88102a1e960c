#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace trajet::detail {

/// JSON that stands inside an HTML script element, handed on in parts, so that it is never whole in memory.
class ScriptText {
 public:
  using Sink = std::function<void(std::string_view)>;

  /// Text is handed on when it has grown to this many bytes.
  static constexpr std::size_t kPartSize = 1 << 16;

  /// `write` outlives the text.
  explicit ScriptText(const Sink& write) : write_(write) {}

  /// A part of JSON without blanks between its values. `<` occurs in strings only, where it may be escaped.
  void add(std::string_view json);
  void add_value(const nlohmann::ordered_json& value);
  /// The next part of JSON that may have blanks between its values; they are left out.
  void add_laid_out(std::string_view json);
  /// Hands on what is left.
  void finish();

 private:
  void append(char c);

  const Sink& write_;
  std::string text_;
  bool in_string_ = false;   // of what is laid out
  bool is_escaped_ = false;  // the next character of that string
};

}  // namespace trajet::detail
