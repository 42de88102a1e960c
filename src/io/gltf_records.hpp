#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "trajet/sim/run_records.hpp"

namespace trajet::detail {

/// Writes a binary glTF file, part by part, with the impacts and the events of a run in the place of `mark`, which its
/// JSON holds once: `"impacts":[…],"events":[…]`. Throws FileError where the file would be larger than glTF allows.
void write_with_records(const std::string& glb, std::string_view mark, const RunRecords& records,
                        const std::function<void(std::string_view)>& write);

}  // namespace trajet::detail
