#pragma once

#include <functional>
#include <string>

namespace trajet {

/// The content of an answer, and what it is: "text/html; charset=utf-8".
struct Answer {
  std::string body;
  std::string type;
};

/// A web server for one browser on this machine: it answers GET requests one after the other, and says "not found"
/// where there is no answer. Only the loopback interface, at a port that the system chooses.
class LoopbackServer {
 public:
  /// Throws FileError if there is no port.
  LoopbackServer();
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  /// `http://127.0.0.1:PORT/`.
  const std::string& address() const { return address_; }

  /// Never returns, unless waiting for requests fails: FileError. `respond` takes the path, "/version", without query;
  /// no body and no type: not found.
  [[noreturn]] void serve(const std::function<Answer(const std::string& path)>& respond);

 private:
  int socket_;
  std::string address_;
};

}  // namespace trajet
