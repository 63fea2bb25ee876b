// Requests to the page, byte for byte: good ones, and what no browser would send.
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dspm::test {

/// Where a page is.
struct Place {
  int port;
  std::string prefix = "/";  // of all its paths
};

inline Place place_in(const std::string& url) {
  const std::size_t port = url.find(':', 6) + 1, path = url.find('/', port);
  return {std::stoi(url.substr(port)), url.substr(path, url.find_last_of('/') + 1 - path)};
}

class Connection {
 public:
  explicit Connection(const Place& place) : Connection(place.port) {}
  explicit Connection(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{15, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("nobody listens");
  }
  ~Connection() { close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// Until the text is there, the other side has no more to say, or 20 s have passed.
  std::string read_until(std::string_view text) {
    char buffer[65536];
    const auto begin = std::chrono::steady_clock::now();  // events go on for ever
    while ((text.empty() || read_.find(text) == read_.npos) &&
           std::chrono::steady_clock::now() - begin < std::chrono::seconds(20)) {
      const ssize_t got = recv(socket_, buffer, sizeof buffer, 0);
      if (got <= 0) break;
      read_.append(buffer, static_cast<std::size_t>(got));
    }
    return read_;
  }
  std::string read_all() { return read_until(""); }
  /// Within so many seconds; nothing is kept.
  bool is_ended_within(double seconds) const {
    const timeval patience{static_cast<time_t>(seconds), static_cast<suseconds_t>(1e6 * std::fmod(seconds, 1))};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    char buffer[65536];
    ssize_t got = 0;
    do got = recv(socket_, buffer, sizeof buffer, 0);
    while (got > 0);
    return got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }

 private:
  int socket_;
  std::string read_;
};

/// `path`: from the page's own on. `headers`: lines that end with \r\n. Without a Host of its own, the page's.
inline std::string request_text(const Place& place, const std::string& method, const std::string& path,
                                const std::string& headers = "", const std::string& body = "") {
  std::string text = fmt::format("{} {}{} HTTP/1.1\r\nConnection: close\r\n", method, place.prefix, path.substr(1));
  if (headers.find("Host:") == headers.npos) text += fmt::format("Host: 127.0.0.1:{}\r\n", place.port);
  if (method == "POST" && headers.find("Length:") == headers.npos && headers.find("chunked") == headers.npos)
    text += fmt::format("Content-Length: {}\r\n", body.size());
  return text + headers + "\r\n" + body;
}

/// The whole answer.
inline std::string ask(const Place& place, const std::string& method, const std::string& path,
                       const std::string& headers = "", const std::string& body = "") {
  Connection connection(place);
  connection.send(request_text(place, method, path, headers, body));
  return connection.read_all();
}

inline int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") && answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
}

}  // namespace dspm::test
