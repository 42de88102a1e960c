#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trajet/error.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

/// Line and column, from 1; columns count bytes.
struct TextPosition {
  int line;
  int column;
};

/// A parsed TOML text that knows where in the file everything stands.
class TomlDocument {
 public:
  /// Parses `text`, which outlives the document; `file` names it in errors. `first_line`: the number in the file of its
  /// first line. Throws InputError where it is no TOML.
  TomlDocument(std::string_view text, TextName file, int first_line = 1);

  const toml::table& root() const { return root_; }
  const TextName& file() const { return file_; }

  SourceLocation location(const toml::node& node) const { return location(node.source().begin); }
  SourceLocation location(const toml::key& key) const { return location(key.source().begin); }

  /// The number of a node in extended precision, from its text; `number` itself where that is not decimal.
  Extended exact_number(const toml::node& node, double number) const;

  /// Where each byte of a string's content stands, and where the content ends. Escape sequences count as the bytes they
  /// stand for.
  std::vector<TextPosition> content_positions(const toml::value<std::string>& value) const;

 private:
  SourceLocation location(const toml::source_position& position) const;
  /// Offset in the text of a position that counts code points.
  std::size_t offset(const toml::source_position& position) const;

  std::string_view text_;
  TextName file_;
  int first_line_;
  std::vector<std::size_t> line_offsets_;
  toml::table root_;
};

/// A key with its value.
using TomlEntry = std::pair<const toml::key*, const toml::node*>;

/// The entries of a table in the order of the file.
std::vector<TomlEntry> entries_in_file_order(const toml::table& table);

/// "a string", "an array", … for messages.
std::string_view type_name(const toml::node& node);

}  // namespace trajet::detail
