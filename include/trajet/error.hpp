#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace trajet {

/// The name of a text that a user wrote: of a file, or what else messages call it. Copies share it, so that a hundred
/// thousand places know it at no cost.
class TextName {
 public:
  TextName() = default;
  TextName(std::string name)  // NOLINT(google-explicit-constructor): a name is a text
      : name_(name.empty() ? nullptr : std::make_shared<const std::string>(std::move(name))) {}
  TextName(const char* name) : TextName(std::string(name)) {}  // NOLINT(google-explicit-constructor)

  const std::string& str() const {
    static const std::string none;
    return name_ ? *name_ : none;
  }
  operator const std::string&() const { return str(); }  // NOLINT(google-explicit-constructor)
  bool empty() const { return !name_; }

  friend bool operator==(const TextName& a, const TextName& b) { return a.str() == b.str(); }

 private:
  std::shared_ptr<const std::string> name_;
};

/// A place in a text that a user wrote. Lines and columns count from 1; 0 means unknown. Columns count bytes.
struct SourceLocation {
  TextName file;
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
    std::string text = where.file.str();
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
