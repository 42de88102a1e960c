#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trajet {

/// Streams of bytes that are written side by side and later read one by one, in little memory: what does not fit lies
/// in a file without a name, which is gone when the program ends, however it ends. Failures are FileErrors.
class Spool {
 public:
  /// So much is kept in memory, bytes: of all streams, and for each of them, so that each lies in pieces of that size.
  static constexpr std::size_t kMemory = std::size_t{1} << 20U;
  static constexpr std::size_t kMemoryOfStream = std::size_t{1} << 11U;

  /// The file, if one is needed, is made in the folder of `beside`, which is going to be written, or in the system's
  /// one for temporary files where `beside` is a stream.
  Spool(const std::string& beside, std::size_t stream_count);
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;
  ~Spool();

  /// All of the bytes, or none where memory has run out.
  void append(std::size_t stream, std::string_view bytes);

  /// Reads one stream from its begin. The spool outlives it; nothing is appended meanwhile.
  class Reader {
   public:
    Reader(const Spool& spool, std::size_t stream) : spool_(spool), stream_(stream) {}
    /// Fills `bytes`. False at the end of the stream.
    bool read(std::span<char> bytes);

   private:
    bool refill();

    const Spool& spool_;
    std::size_t stream_;
    std::size_t extent_ = 0;       // from which comes what is read next
    std::uint64_t in_extent_ = 0;  // how much of it has been
    bool is_tail_read_ = false;
    std::string buffer_;
    std::size_t at_ = 0;  // in the buffer
  };

  /// How much lies in the file, bytes.
  std::uint64_t file_size() const { return file_size_; }

 private:
  struct Extent {
    std::uint64_t at = 0;
    std::uint64_t size = 0;
  };
  struct Stream {
    std::vector<Extent> extents;  // in the file
    std::string tail;             // behind them
  };

  void write_tails();
  void open();

  std::string folder_;
  std::vector<Stream> streams_;
  std::size_t in_memory_ = 0;
  std::uint64_t file_size_ = 0;
  int file_ = -1;
};

}  // namespace trajet
