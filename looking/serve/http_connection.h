// One connection of a browser: its requests one after the other, each within bounds of memory and time.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <optional>
#include <string>

#include "dspm/looking/serve/http_server.h"

namespace dspm {

class HttpConnection {
 public:
  using Clock = std::chrono::steady_clock;
  using Socket = boost::asio::ip::tcp::socket;

  Socket& socket() { return stream_.socket(); }
  /// Serves on the thread of the connection, until the other side leaves, misbehaves or is slow, or `closing`.
  void serve(const HttpServer::Site& site, const std::atomic<bool>& closing);
  void close() { stream_.close(); }
  /// Gives up whatever is being read or written. Any thread may call it.
  void end() {
    boost::asio::post(context_, [this] { stream_.close(); });
  }
  /// Returns since when it waits for the other side to ask; nullopt while it gives an answer.
  std::optional<Clock::time_point> waits_since() const;

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;

  /// Serves one request and its answer. Returns false if it was the last.
  bool serve_one(const HttpServer::Site& site);
  bool read_head(Parser& parser, const HttpServer::Site& site);
  bool read_body(Parser& parser);
  bool send(HttpAnswer answer, const HttpServer::Site& site, const Parser& parser, bool stays);
  bool send_texts(const std::function<std::string()>& next, const boost::beast::http::response_header<>& head);
  bool refuse(int status, std::string_view reason, const HttpServer::Site& site, const Parser& parser);
  void part();
  void begin_waiting();
  /// Calls start(handler) and waits until that has ended. Returns false if it failed, took too long or was given up.
  template <class Start>
  bool finish(Start&& start) {
    start([this](boost::beast::error_code error, std::size_t) { error_ = error; });
    context_.restart();
    context_.run();
    return !error_;
  }

  static constexpr Clock::rep kAnswers = 0;

  boost::asio::io_context context_{1};
  boost::beast::tcp_stream stream_{context_};
  boost::beast::flat_buffer buffer_;
  boost::beast::error_code error_;
  std::atomic<Clock::rep> waits_since_ = Clock::now().time_since_epoch().count();
};

}  // namespace dspm
