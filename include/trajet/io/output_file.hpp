#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace trajet {

/// Whether what is written to that name goes on to somebody else: `-`, a device, a pipe, or an open descriptor under a
/// name such as /dev/stdout.
bool is_stream(const std::string& path);

/// A text file to write, or standard output under the name `-`. Every failure to write is a FileError.
///
/// A file that exists is replaced as a whole by `finish`: until then it stays as it is, and what is written goes to a
/// file beside it. A new file grows where it is, so that it can be watched. Streams are written as they are.
class OutputFile {
 public:
  /// Creates the file, or one beside it.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Closes without complaint. A file that was to be replaced stays as it was unless `finish` has been called.
  ~OutputFile();

  void write(std::string_view text);
  /// Writes what is buffered, and puts the file in the place of the one that was there. Nothing can be written after.
  void finish();

 private:
  void open_beside();
  void replace();
  void discard_beside();
  [[noreturn]] void fail() const;

  std::string path_;
  std::string replaced_;  ///< the file to be replaced, behind all links; empty if there is none
  std::string beside_;    ///< what is written instead until `finish`; empty if there is none
  std::FILE* file_ = nullptr;
};

}  // namespace trajet
