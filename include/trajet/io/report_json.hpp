#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "trajet/sim/run_records.hpp"

namespace trajet {

/// The JSON report of a run: docs/formats/report.md. Numbers read back as the same doubles; what is not finite is
/// `null`.
///
/// `write` gets the text part by part: the memory that is needed beside the result does not grow with it.
void write_report_json(const RunResult& result, const std::function<void(std::string_view)>& write);
/// The same where the impacts and events of the run have been kept elsewhere.
void write_report_json(const RunResult& result, const RunRecords& records,
                       const std::function<void(std::string_view)>& write);

/// The same in one text.
std::string report_json(const RunResult& result);

}  // namespace trajet
