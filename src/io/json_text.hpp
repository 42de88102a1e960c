#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace trajet::detail {

using Json = nlohmann::ordered_json;

/// JSON as a person would lay it out: vectors and matrices on one line, everything else one line per member.
std::string json_text(const Json& json);

/// Writes one object in that layout, member by member, long arrays element by element: the text is handed on in parts
/// and is never whole in memory.
class JsonObjectWriter {
 public:
  using Sink = std::function<void(std::string_view)>;

  /// Texts are handed on when they have grown to this many bytes.
  static constexpr std::size_t kPartSize = 1 << 16;

  /// `write` outlives the writer.
  explicit JsonObjectWriter(const Sink& write) : write_(write) {}

  void member(std::string_view key, const Json& value);

  /// An array of what `write_items(add)` calls `add` with, one after the other: objects that are not empty.
  template <class WriteItems>
  void array(std::string_view key, const WriteItems& write_items) {
    begin_member(key);
    bool is_empty = true;
    write_items([&](const Json& item) {
      add_item(is_empty ? "[" : ",", item);
      is_empty = false;
    });
    text_ += is_empty ? "[]" : "\n  ]";
  }

  /// Closes the object. Nothing may follow.
  void finish();

 private:
  void begin_member(std::string_view key);
  void add_item(const char* separator, const Json& item);
  void hand_on_if_long();

  const Sink& write_;
  std::string text_;
  bool is_empty_ = true;
};

}  // namespace trajet::detail
