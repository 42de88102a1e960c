#include "value_reader.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet::detail {

namespace {

std::string quote(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string join(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::string expected_scalar(std::optional<Dimension> expected) {
  const std::string what = expected && *expected != kDimensionless ? describe(*expected) : "a number";
  return what + " expected (a number, a quantity such as \"5 m/s\" or an expression)";
}

}  // namespace

SourceLocation TableReader::where(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node == nullptr ? where_ : document_.location(*node);
}

void TableReader::check_keys(std::span<const std::string_view> allowed) const {
  for (const auto& [key, node] : entries_in_file_order(table_)) {
    const std::string_view name = key->str();
    if (ranges::find(allowed, name) != allowed.end()) continue;
    const std::string hint = did_you_mean(name, allowed);
    throw InputError(document_.location(*key), "unknown key " + quote(name) + " in " + title_ +
                                                   (hint.empty() ? ", expected one of: " + join(allowed) : hint));
  }
}

void TableReader::fail(std::string_view key, const std::string& message) const {
  throw InputError(where(key), message);
}

void TableReader::fail_type(const toml::node& node, const std::string& expected) const {
  throw InputError(document_.location(node), expected + ", got " + std::string(type_name(node)));
}

const toml::node& TableReader::required(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) throw InputError(where_, title_ + " lacks the key " + quote(key));
  return *node;
}

const toml::array& TableReader::array(std::string_view key, std::size_t count) const {
  const toml::node& node = required(key);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != count) {
    const std::string expected = quote(key) + ": an array of " + std::to_string(count) + " expected";
    if (array != nullptr) fail(key, expected + ", got " + std::to_string(array->size()));
    fail_type(node, expected);
  }
  return *array;
}

std::string TableReader::text(std::string_view key) const {
  const toml::node& node = required(key);
  if (!node.is_string()) fail_type(node, quote(key) + ": a string expected");
  return node.as_string()->get();
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
  const toml::node& node = required(key);
  const std::string expected = quote(key) + ": an array of strings expected";
  if (!node.is_array()) fail_type(node, expected);
  std::vector<std::string> found;
  for (const toml::node& each : *node.as_array()) {
    if (!each.is_string()) fail_type(each, expected);
    found.push_back(each.as_string()->get());
  }
  return found;
}

bool TableReader::flag(std::string_view key) const {
  const toml::node& node = required(key);
  if (!node.is_boolean()) fail_type(node, quote(key) + ": true or false expected");
  return node.as_boolean()->get();
}

long TableReader::whole_number(std::string_view key, long smallest, long default_value) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return default_value;
  const std::string expected = quote(key) + ": a whole number of at least " + std::to_string(smallest) + " expected";
  if (!node->is_integer()) fail_type(*node, expected);
  const std::int64_t value = node->as_integer()->get();
  if (value < smallest) fail(key, expected + ", got " + std::to_string(value));
  return static_cast<long>(value);
}

Expression TableReader::expression_of(const toml::value<std::string>& value, std::optional<Dimension> expected) const {
  const std::string& text = value.get();
  const std::vector<TextPosition> positions = document_.content_positions(value);
  const SourceLocation in_content{document_.file(), 1, 1};
  const auto place = [&](const SourceLocation& where) {
    std::size_t offset = 0;
    for (int line = 1; line < where.line; ++line) offset = text.find('\n', offset) + 1;
    const TextPosition& position =
        positions[std::min(offset + static_cast<std::size_t>(where.column) - 1, text.size())];
    return SourceLocation{document_.file(), position.line, position.column};
  };
  const auto read = [&] {
    try {
      return formulas_.read(text, in_content, expected).relocated(place);
    } catch (const InputError& error) {
      throw InputError(place(error.where()), error.message());
    }
  };
  Expression formula = read();
  formulas_.read_tables(formula);
  return formula;
}

Expression TableReader::scalar_of(const toml::node& node, std::optional<Dimension> expected) const {
  if (node.is_string()) return expression_of(*node.as_string(), expected);
  if (!node.is_number()) fail_type(node, expected_scalar(expected));
  const SourceLocation where = document_.location(node);
  const double number = *node.value<double>();
  if (!std::isfinite(number)) throw InputError(where, "a finite number expected, got " + std::to_string(number));
  return Expression::number({number, document_.exact_number(node, number)}, where);
}

Expression TableReader::vector_of(const toml::node& node, std::optional<Dimension> expected) const {
  const std::string wanted = "a vector expected (an array of three or a vector expression)";
  if (const toml::value<std::string>* value = node.as_string()) {
    if (split_quantity(value->get()))
      throw InputError(document_.location(node),
                       wanted + ", got a scalar quantity: write its direction too, [\"" + value->get() + "\", 0, 0]");
    return expression_of(*value, expected);
  }
  const toml::array* array = node.as_array();
  if (node.is_number()) throw InputError(document_.location(node), wanted + ", got a number: write its direction too");
  if (array == nullptr) fail_type(node, wanted);
  if (array->size() != 3)
    throw InputError(document_.location(node), wanted + ", got " + std::to_string(array->size()) + " elements");
  const Expression x = scalar_of(*array->get(0), expected);  // one after the other: the first fault is the one reported
  const Expression y = scalar_of(*array->get(1), expected);
  const Expression z = scalar_of(*array->get(2), expected);
  return Expression::vector(x, y, z);
}

Expression TableReader::scalar(std::string_view key, std::optional<Dimension> expected) const {
  return scalar_of(required(key), expected);
}

Expression TableReader::vector(std::string_view key, std::optional<Dimension> expected) const {
  return vector_of(required(key), expected);
}

Expression TableReader::formula(std::string_view key) const {
  const toml::node& node = required(key);
  return node.is_array() ? vector_of(node, std::nullopt) : scalar_of(node, std::nullopt);
}

std::vector<Expression> TableReader::scalars(std::string_view key, std::size_t count, Dimension expected) const {
  std::vector<Expression> values;
  for (const toml::node& node : array(key, count)) values.push_back(scalar_of(node, expected));
  return values;
}

std::vector<Expression> TableReader::vectors(std::string_view key, std::size_t count, Dimension expected) const {
  std::vector<Expression> values;
  for (const toml::node& node : array(key, count)) values.push_back(vector_of(node, expected));
  return values;
}

std::vector<Expression> TableReader::scalar_list(std::string_view key, Dimension expected) const {
  const toml::node& node = required(key);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) fail_type(node, quote(key) + ": a non-empty array of numbers expected");
  std::vector<Expression> values;
  for (const toml::node& element : *array) values.push_back(scalar_of(element, expected));
  return values;
}

std::vector<Expression> TableReader::vector_list(std::string_view key, Dimension expected) const {
  const toml::node& node = required(key);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) fail_type(node, quote(key) + ": a non-empty array of vectors expected");
  std::vector<Expression> values;
  for (const toml::node& element : *array) values.push_back(vector_of(element, expected));
  return values;
}

TableReader TableReader::subtable(std::string_view key) const {
  const toml::node& node = required(key);
  if (!node.is_table()) fail_type(node, quote(key) + ": a table expected");
  return {document_, *node.as_table(), quote(key), document_.location(node), formulas_};
}

std::vector<TableReader> TableReader::subtables(std::string_view key, const std::string& title) const {
  const toml::node& node = required(key);
  if (!node.is_array() || node.as_array()->empty()) fail_type(node, quote(key) + ": an array of tables expected");
  std::vector<TableReader> tables;
  for (const toml::node& each : *node.as_array()) {
    if (!each.is_table()) fail_type(each, quote(key) + ": an array of tables expected");
    tables.push_back({document_, *each.as_table(), title, document_.location(each), formulas_});
  }
  return tables;
}

std::optional<Expression> TableReader::optional_scalar(std::string_view key, Dimension expected) const {
  return has(key) ? std::optional(scalar(key, expected)) : std::nullopt;
}

std::optional<Expression> TableReader::optional_vector(std::string_view key, Dimension expected) const {
  return has(key) ? std::optional(vector(key, expected)) : std::nullopt;
}

std::size_t TableReader::choice(std::string_view key, std::span<const std::string_view> choices,
                                std::size_t default_choice) const {
  if (!has(key)) return default_choice;
  const std::string word = text(key);
  const auto found = ranges::find(choices, word);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  fail(key, "unknown " + std::string(key) + " " + quote(word) + ", expected one of: " + join(choices) +
                did_you_mean(word, choices));
}

}  // namespace trajet::detail
