#pragma once

#include <stdexcept>
#include <string>

namespace trajet {

/// A place in a text that a user wrote. Lines and columns count from 1; 0 means unknown. Columns count bytes.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// A user's input is wrong: a scene, an expression, an option.
///
/// `what()` is the whole message, `FILE:LINE:COLUMN: error: message` where the place is known.
/// The parts stay separate so that a page or an editor can show them in its own way.
class InputError : public std::runtime_error {
 public:
  InputError(SourceLocation where, const std::string& message)
      : std::runtime_error(format(where, message)), where_(std::move(where)), message_(message) {}

  const SourceLocation& where() const { return where_; }
  /// The message without the place.
  const std::string& message() const { return message_; }

 private:
  static std::string format(const SourceLocation& where, const std::string& message) {
    std::string text = where.file;
    if (where.line > 0) {
      if (!text.empty()) text += ':';
      text += std::to_string(where.line) + ':' + std::to_string(where.column);
    }
    if (!text.empty()) text += ": ";
    return text + "error: " + message;
  }

  SourceLocation where_;
  std::string message_;
};

/// A file could not be read or written.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// For a file that is named at `where`; `what()` as of an InputError.
  FileError(const SourceLocation& where, const std::string& message)
      : std::runtime_error(InputError(where, message).what()), has_place_(true) {}

  /// Whether `what()` begins with the place where the file is named.
  bool has_place() const { return has_place_; }

 private:
  bool has_place_ = false;
};

}  // namespace trajet
