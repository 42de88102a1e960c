#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace trajet {

/// The name of a text that a user wrote: of a file, or what else messages call it. Copies share it, so that a hundred
/// thousand places know it, each by one pointer.
class TextName {
 public:
  TextName() = default;
  TextName(std::string name)  // NOLINT(google-explicit-constructor): a name is a text
      : shared_(name.empty() ? nullptr : new Shared{{1}, std::move(name)}) {}
  TextName(const char* name) : TextName(std::string(name)) {}  // NOLINT(google-explicit-constructor)
  TextName(const TextName& other) noexcept : shared_(other.shared_) {
    if (shared_ != nullptr) shared_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  TextName(TextName&& other) noexcept : shared_(std::exchange(other.shared_, nullptr)) {}
  TextName& operator=(TextName other) noexcept {
    std::swap(shared_, other.shared_);
    return *this;
  }
  ~TextName() {
    if (shared_ != nullptr && shared_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared_;
  }

  const std::string& str() const {
    static const std::string none;
    return shared_ != nullptr ? shared_->name : none;
  }
  operator const std::string&() const { return str(); }  // NOLINT(google-explicit-constructor)
  bool empty() const { return shared_ == nullptr; }

  friend bool operator==(const TextName& a, const TextName& b) { return a.shared_ == b.shared_ || a.str() == b.str(); }

 private:
  struct Shared {
    std::atomic<long> owners;
    std::string name;
  };
  Shared* shared_ = nullptr;
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
