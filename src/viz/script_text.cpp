#include "script_text.hpp"

namespace trajet::detail {

void ScriptText::add(std::string_view json) {
  for (const char c : json) append(c);
}

void ScriptText::add_value(const nlohmann::ordered_json& value) {
  // A file name may hold bytes that are no UTF-8.
  add(value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void ScriptText::add_laid_out(std::string_view json) {
  for (const char c : json) {
    if (!in_string_ && (c == ' ' || c == '\n')) continue;
    if (c == '"' && !is_escaped_) in_string_ = !in_string_;
    is_escaped_ = in_string_ && c == '\\' && !is_escaped_;
    append(c);
  }
}

void ScriptText::finish() {
  write_(text_);
  text_.clear();
}

void ScriptText::append(char c) {
  if (c == '<')
    text_ += "\\u003c";
  else
    text_ += c;
  if (text_.size() >= kPartSize) finish();
}

}  // namespace trajet::detail
