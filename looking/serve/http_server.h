// HTTP for a few browsers. This is the only place with Boost.Beast. Whatever somebody sends, its memory and its time
// are bounded: a head has 16 KiB and 100 headers, a body 64 KiB and no encoding, a whole request ten seconds to arrive.
// A body is read only after its head has been let in.
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
  /// Replaces the body: returns the next text as long as the other side stays, and an empty one when that was all.
  std::function<std::string()> next = {};
};

/// Returns an answer with a sentence of its own.
HttpAnswer http_refusal(int status, std::string_view reason);

class HttpServer {
 public:
  struct Site {
    std::vector<std::pair<std::string, std::string>> headers;  // of every answer
    /// Refuses a request by its head alone. Many threads call both functions.
    std::function<std::optional<HttpAnswer>(const HttpRequest&)> refusal;
    std::function<HttpAnswer(const HttpRequest&)> answer;
  };

  /// Listens; port 0 takes any that is free. Throws std::runtime_error if it cannot.
  HttpServer(const std::string& host, int port);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  /// Serves the site until the end; call it once.
  void serve(Site site);
  /// Gives answers that are under way a second. The site is not called any more after that.
  void end();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dspm
