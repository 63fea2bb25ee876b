// HTTP for a few browsers. The only place with Boost.Beast. Whatever somebody sends, its memory and its time are bounded:
// a head has 16 KiB and 100 headers, a body 64 KiB and no encoding, a whole request ten seconds
// to arrive. A body is read only after its head has been let in.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dspm {

struct HttpRequest {
  std::string method, path;                          // the path as it was sent, without what follows a '?'
  std::string host, origin, fetch_site, last_event;  // headers; empty: absent
  std::string body = {};
};

struct HttpAnswer {
  int status = 200;
  std::string type = {}, body = {};
  /// In place of a body, as long as the other side stays: the next text; empty: that was all.
  std::function<std::string()> next = {};
};

/// A sentence of its own.
HttpAnswer http_refusal(int status, std::string_view reason);

class HttpServer {
 public:
  struct Site {
    std::vector<std::pair<std::string, std::string>> headers;  // of every answer
    /// By the head alone. Both are called by many threads.
    std::function<std::optional<HttpAnswer>(const HttpRequest&)> refusal;
    std::function<HttpAnswer(const HttpRequest&)> answer;
  };

  /// Listens; port 0: any that is free. Throws std::runtime_error if it cannot.
  HttpServer(const std::string& host, int port);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Once, until the end.
  void serve(Site site);
  /// Gives answers that are under way a second. The site is not called any more.
  void end();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dspm
