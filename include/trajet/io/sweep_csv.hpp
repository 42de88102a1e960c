#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "trajet/ensemble/sweep.hpp"
#include "trajet/ensemble/sweep_summary.hpp"

namespace trajet {

/// The first `column_count` columns of a sweep are those that are written.
SweepHeader sweep_header(const Sweep& sweep, std::size_t column_count);

/// The lines of a table, with their ends. Numbers are the shortest that read back as the same doubles; what a motion
/// does not have is empty.
std::string csv_line(const SweepHeader& header);
void append_csv_line(const SweepRow& row, std::size_t column_count, std::string& text);

/// The header that a line without its end is. Throws InputError without a place.
SweepHeader read_csv_header(std::string_view line, std::size_t quantity_count);
/// The row that a line without its end is; its status is not known from it. Throws InputError without a place.
SweepRow read_csv_row(std::string_view line, std::size_t quantity_count);

/// The fields of a line, quoted ones without quotes.
std::vector<std::string> csv_fields(std::string_view line);

}  // namespace trajet
