#include "trajet/io/sweep_csv.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "csv_field.hpp"
#include "trajet/error.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet {
namespace {

void append_number(std::string& text, double value) {
  fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), value);
}

}  // namespace

SweepHeader sweep_header(const Sweep& sweep, std::size_t column_count) {
  SweepHeader header;
  for (std::size_t i = 0; i < sweep.plan().quantity_count(); ++i)
    header.quantities.push_back(sweep.plan().quantity(i).name);
  const std::vector<std::string>& texts = sweep.columns().texts();
  header.columns.assign(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(column_count));
  return header;
}

std::string csv_line(const SweepHeader& header) {
  std::string line = "index";
  for (const auto* names : {&header.quantities, &header.columns})
    for (const std::string& name : *names) {
      line += ',';
      line += detail::csv_field(name);
    }
  return line + "\n";
}

void append_csv_line(const SweepRow& row, std::size_t column_count, std::string& text) {
  fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), row.index);
  for (const double value : row.values) {
    text += ',';
    append_number(text, value);
  }
  for (std::size_t i = 0; i < column_count; ++i) {
    text += ',';
    const Cell& cell = row.cells[i];
    if (const auto* number = std::get_if<double>(&cell)) append_number(text, *number);
    if (const auto* word = std::get_if<std::string>(&cell)) text += detail::csv_field(*word);
  }
  text += '\n';
}

std::vector<std::string> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (is_quoted) {
      if (c != '"')
        fields.back() += c;
      else if (i + 1 < line.size() && line[i + 1] == '"')
        fields.back() += line[++i];
      else
        is_quoted = false;
    } else if (c == '"') {
      is_quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

SweepHeader read_csv_header(std::string_view line, std::size_t quantity_count) {
  std::vector<std::string> fields = csv_fields(line);
  if (fields.front() != "index" || fields.size() <= quantity_count)
    throw InputError({}, "the header of a sweep's table expected: index, …");
  const auto columns = fields.begin() + 1 + static_cast<std::ptrdiff_t>(quantity_count);
  return {{fields.begin() + 1, columns}, {columns, fields.end()}};
}

SweepRow read_csv_row(std::string_view line, std::size_t quantity_count) {
  const std::vector<std::string> fields = csv_fields(line);
  const auto fault = [&](const std::string& field) { return InputError({}, "a number expected, got '" + field + "'"); };
  if (fields.size() <= quantity_count)
    throw InputError({}, "a row of a sweep expected, got '" + std::string(line) + "'");
  SweepRow row;
  const std::optional<double> index = finite_number(fields.front());
  if (!index || *index < 0.0 || *index != std::floor(*index)) throw fault(fields.front());
  row.index = static_cast<std::uint64_t>(*index);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::optional<DecimalNumber> number = leading_number(fields[i]);
    const bool is_number = number && number->length == fields[i].size();
    if (i <= quantity_count) {
      if (!is_number) throw fault(fields[i]);
      row.values.push_back(number->value);
    } else if (fields[i].empty()) {
      row.cells.emplace_back();
    } else if (is_number) {
      row.cells.emplace_back(number->value);
    } else {
      row.cells.emplace_back(fields[i]);
    }
  }
  return row;
}

}  // namespace trajet
