#include "json_text.hpp"

#include <algorithm>

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr std::size_t kIndent = 2;

/// Whether a value stands on one line: numbers, strings, and arrays of them.
bool is_short(const Json& json) {
  if (!json.is_structured() || json.empty()) return true;
  return json.is_array() &&
         ranges::none_of(json, [](const Json& item) { return item.is_object() || item.is_string(); });
}

void append(std::string& text, const Json& json, std::size_t indent) {
  if (is_short(json)) {
    // A file name may hold bytes that are no UTF-8.
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  text += json.is_object() ? "{" : "[";
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    text += separator + std::string(indent + kIndent, ' ');
    if (json.is_object()) text += Json(key).dump() + ": ";
    append(text, value, indent + kIndent);
    separator = ",\n";
  }
  text += "\n" + std::string(indent, ' ') + (json.is_object() ? "}" : "]");
}

}  // namespace

std::string json_text(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

void JsonObjectWriter::member(std::string_view key, const Json& value) {
  begin_member(key);
  append(text_, value, kIndent);
  hand_on_if_long();
}

void JsonObjectWriter::finish() {
  text_ += is_empty_ ? "{}\n" : "\n}\n";
  write_(text_);
  text_.clear();
}

void JsonObjectWriter::begin_member(std::string_view key) {
  text_ += is_empty_ ? "{\n  " : ",\n  ";
  text_ += Json(key).dump() + ": ";
  is_empty_ = false;
}

void JsonObjectWriter::add_item(const char* separator, const Json& item) {
  text_ += separator;
  text_ += "\n" + std::string(2 * kIndent, ' ');
  append(text_, item, 2 * kIndent);
  hand_on_if_long();
}

void JsonObjectWriter::hand_on_if_long() {
  if (text_.size() < kPartSize) return;
  write_(text_);
  text_.clear();
}

}  // namespace trajet::detail
