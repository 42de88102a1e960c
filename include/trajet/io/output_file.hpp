#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace trajet {

/// A text file to write, or standard output under the name `-`. Every failure to write is a FileError.
class OutputFile {
 public:
  /// Creates or truncates the file.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Closes without complaint; call `finish` to learn of a full disk.
  ~OutputFile();

  void write(std::string_view text);
  /// Writes what is buffered.
  void finish();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::FILE* file_;
};

}  // namespace trajet
