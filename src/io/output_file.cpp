#include "trajet/io/output_file.hpp"

#include <cerrno>
#include <cstring>

#include "trajet/error.hpp"

namespace trajet {

OutputFile::OutputFile(const std::string& path)
    : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (file_ != stdout) std::fclose(file_);
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void OutputFile::finish() {
  if (std::fflush(file_) != 0) fail();
}

void OutputFile::fail() const {
  const std::string reason = std::strerror(errno);
  throw FileError("cannot write " + (path_ == "-" ? "to standard output" : "'" + path_ + "'") + ": " + reason);
}

}  // namespace trajet
