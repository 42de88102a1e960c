#include "trajet/io/output_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "trajet/error.hpp"

namespace trajet {

namespace {

namespace fs = std::filesystem;

/// The regular file of that name behind all links, empty if there is none.
std::string existing_file(const std::string& path) {
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) return {};
  return fs::canonical(path, unknown).string();
}

}  // namespace

bool is_stream(const std::string& path) {
  if (path == "-" || path == "/dev/stdout" || path == "/dev/stderr") return true;
  const std::string_view name = path;
  if (name.starts_with("/dev/fd/") || name.starts_with("/proc/")) return true;
  std::error_code unknown;
  return fs::is_other(path, unknown);
}

OutputFile::OutputFile(const std::string& path)
    : path_(path), replaced_(is_stream(path) ? std::string() : existing_file(path)) {
  if (!replaced_.empty())
    open_beside();
  else
    file_ = path == "-" ? stdout : std::fopen(path.c_str(), "wb");
  if (file_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  discard_beside();
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void OutputFile::finish() {
  if (std::fflush(file_) != 0) fail();
  if (!beside_.empty()) replace();
}

/// Leaves `file_` null and errno set where the file may not be written or no other can be made beside it.
void OutputFile::open_beside() {
  if (access(replaced_.c_str(), W_OK) != 0) return;
  std::string name = replaced_ + ".XXXXXX";
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) return;
  beside_ = name;
  struct stat old = {};
  if (stat(replaced_.c_str(), &old) == 0 && fchmod(descriptor, old.st_mode & 07777) == 0)
    file_ = fdopen(descriptor, "wb");
  if (file_ != nullptr) return;
  const int reason = errno;
  close(descriptor);
  discard_beside();
  errno = reason;
}

void OutputFile::replace() {
  // The disk has the text before the name leads to it: a crash leaves the one or the other file, whole.
  if (fsync(fileno(file_)) != 0) fail();
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(beside_.c_str(), replaced_.c_str()) != 0) fail();
  beside_.clear();
}

void OutputFile::discard_beside() {
  if (!beside_.empty()) unlink(beside_.c_str());
  beside_.clear();
}

void OutputFile::fail() const {
  const std::string reason = std::strerror(errno);
  throw FileError("cannot write " + (path_ == "-" ? "to standard output" : "'" + path_ + "'") + ": " + reason);
}

}  // namespace trajet
