#include "gltf_records.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "record_json.hpp"
#include "trajet/error.hpp"

namespace trajet::detail {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF has little-endian numbers");

using Write = std::function<void(std::string_view)>;

/// A file is a header of magic, version and length, then the chunks, each after its length and its type.
constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::size_t kLengthInHeader = 8;

/// Writes an array of what `for_each(add)` calls `add` with.
template <class ForEach>
void write_list(std::string_view key, const Write& write, const ForEach& for_each) {
  write("\"" + std::string(key) + "\":[");
  const char* separator = "";
  for_each([&](const Json& item) {
    write(separator + item.dump(-1, ' ', false, Json::error_handler_t::replace));
    separator = ",";
  });
  write("]");
}

void write_records(const RunRecords& records, const Write& write) {
  write_list("impacts", write,
             [&](const auto& add) { records.each_impact([&](const Impact& impact) { add(impact_json(impact)); }); });
  write(",");
  write_list("events", write,
             [&](const auto& add) { records.each_event([&](const EventRecord& event) { add(event_json(event)); }); });
}

std::uint32_t number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void write_number(std::size_t value, const Write& write) {
  if (value > std::numeric_limits<std::uint32_t>::max())
    throw FileError("the animation is larger than the 4 GiB of a glTF file");
  const auto bits = static_cast<std::uint32_t>(value);
  char bytes[sizeof bits];
  std::memcpy(bytes, &bits, sizeof bits);
  write({bytes, sizeof bytes});
}

}  // namespace

void write_with_records(const std::string& glb, std::string_view mark, const RunRecords& records, const Write& write) {
  const std::string_view file = glb;
  const std::size_t json_length = number(file, kHeader);
  std::string_view json = file.substr(kHeader + kChunkHeader, json_length);
  const std::string_view chunks_behind = file.substr(kHeader + kChunkHeader + json_length);
  json = json.substr(0, json.find_last_not_of(' ') + 1);
  const std::size_t at = json.find(mark);

  std::size_t records_length = 0;
  write_records(records, [&](std::string_view part) { records_length += part.size(); });
  const std::size_t length = json.size() - mark.size() + records_length;
  constexpr std::size_t kAlignment = 4;
  const std::size_t padding = (kAlignment - length % kAlignment) % kAlignment;

  write(file.substr(0, kLengthInHeader));
  write_number(kHeader + kChunkHeader + length + padding + chunks_behind.size(), write);
  write_number(length + padding, write);
  write(file.substr(kHeader + sizeof(std::uint32_t), sizeof(std::uint32_t)));
  write(json.substr(0, at));
  write_records(records, write);
  write(json.substr(at + mark.size()));
  write(std::string(padding, ' '));
  write(chunks_behind);
}

}  // namespace trajet::detail
