#include "trajet/io/spool.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"

namespace trajet {

namespace {

namespace fs = std::filesystem;

/// A file in a folder that has lost its name already; negative, with errno, where none can be made.
int open_nameless(const fs::path& folder) {
  std::string name = (folder / ".trajet-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file >= 0) unlink(name.c_str());
  return file;
}

[[noreturn]] void fail(const char* what) {
  const std::string reason = std::strerror(errno);
  throw FileError(std::string("cannot ") + what + " a temporary file: " + reason);
}

}  // namespace

Spool::Spool(const std::string& beside, std::size_t stream_count) : streams_(stream_count) {
  if (!is_stream(beside)) folder_ = fs::absolute(beside).parent_path().string();
}

Spool::~Spool() {
  if (file_ >= 0) close(file_);
}

void Spool::append(std::size_t stream, std::string_view bytes) {
  if (in_memory_ + bytes.size() > kMemory + streams_.size() * kMemoryOfStream) write_tails();
  streams_[stream].tail.append(bytes);
  in_memory_ += bytes.size();
}

void Spool::write_tails() {
  if (file_ < 0) open();
  for (Stream& stream : streams_) {
    if (stream.tail.empty()) continue;
    const bool goes_on = !stream.extents.empty() && stream.extents.back().at + stream.extents.back().size == file_size_;
    if (!goes_on) stream.extents.push_back({file_size_, 0});
    std::string_view rest = stream.tail;
    while (!rest.empty()) {
      const ssize_t count = write(file_, rest.data(), rest.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("write");
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
    stream.extents.back().size += stream.tail.size();
    file_size_ += stream.tail.size();
    in_memory_ -= stream.tail.size();
    stream.tail = {};
  }
}

void Spool::open() {
  if (!folder_.empty()) file_ = open_nameless(folder_);
  if (file_ < 0) file_ = open_nameless(fs::temp_directory_path());
  if (file_ < 0) fail("make");
}

bool Spool::Reader::read(std::span<char> bytes) {
  while (!bytes.empty()) {
    if (at_ == buffer_.size() && !refill()) return false;
    const std::size_t count = std::min(bytes.size(), buffer_.size() - at_);
    std::memcpy(bytes.data(), buffer_.data() + at_, count);
    at_ += count;
    bytes = bytes.subspan(count);
  }
  return true;
}

bool Spool::Reader::refill() {
  constexpr std::uint64_t kPart = 1U << 16U;
  at_ = 0;
  buffer_.clear();
  const Stream& stream = spool_.streams_[stream_];
  if (extent_ == stream.extents.size()) {
    if (std::exchange(is_tail_read_, true)) return false;
    buffer_ = stream.tail;
    return !buffer_.empty();
  }
  const Extent& extent = stream.extents[extent_];
  buffer_.resize(static_cast<std::size_t>(std::min(kPart, extent.size - in_extent_)));
  for (std::size_t filled = 0; filled < buffer_.size();) {
    const ssize_t count = pread(spool_.file_, buffer_.data() + filled, buffer_.size() - filled,
                                static_cast<off_t>(extent.at + in_extent_ + filled));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO;  // somebody has cut it
    if (count <= 0) fail("read");
    filled += static_cast<std::size_t>(count);
  }
  in_extent_ += buffer_.size();
  if (in_extent_ == extent.size) {
    ++extent_;
    in_extent_ = 0;
  }
  return true;
}

}  // namespace trajet
