#include "loopback_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "trajet/error.hpp"

namespace trajet {

namespace {

/// A browser's request is shorter; what is longer is not one of ours.
constexpr std::size_t kMostRequestBytes = 16384;
/// A connection that says nothing for so long is dropped: others wait.
constexpr timeval kPatience{2, 0};

std::string reason() { return std::strerror(errno); }

/// The head of a request, up to the empty line; what there is of it if the other side goes.
std::string read_head(int connection) {
  std::string head;
  char part[2048];
  while (head.size() < kMostRequestBytes && head.find("\r\n\r\n") == std::string::npos) {
    const ssize_t count = recv(connection, part, sizeof part, 0);
    if (count <= 0) break;
    head.append(part, static_cast<std::size_t>(count));
  }
  return head;
}

/// The path of "GET /path?query HTTP/1.1"; empty for anything else.
std::string requested_path(std::string_view head) {
  constexpr std::string_view kGet = "GET ";
  if (!head.starts_with(kGet)) return {};
  head.remove_prefix(kGet.size());
  return std::string(head.substr(0, head.find_first_of(" ?\r\n")));
}

void send_all(int connection, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = send(connection, text.data(), text.size(), MSG_NOSIGNAL);
    if (count <= 0) return;  // the browser has gone
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

LoopbackServer::LoopbackServer() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  constexpr int kWaiting = 16;
  if (socket_ < 0 || bind(socket_, generic, size) != 0 || listen(socket_, kWaiting) != 0 ||
      getsockname(socket_, generic, &size) != 0)
    throw FileError("cannot serve the page: " + reason());
  address_ = fmt::format("http://127.0.0.1:{}/", ntohs(place.sin_port));
}

LoopbackServer::~LoopbackServer() { close(socket_); }

void LoopbackServer::serve(const std::function<Answer(const std::string& path)>& respond) {
  while (true) {
    const int connection = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) {
      if (errno == EINTR || errno == ECONNABORTED) continue;
      throw FileError("cannot serve the page any longer: " + reason());
    }
    setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
    setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
    Answer answer = respond(requested_path(read_head(connection)));
    const bool is_found = !answer.type.empty();
    if (!is_found) answer = {"not found\n", "text/plain; charset=utf-8"};
    send_all(connection, fmt::format("HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
                                     "Cache-Control: no-store\r\nConnection: close\r\n\r\n",
                                     is_found ? "200 OK" : "404 Not Found", answer.type, answer.body.size()));
    send_all(connection, answer.body);
    close(connection);
  }
}

}  // namespace trajet
