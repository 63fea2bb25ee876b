#include "dspm/looking/serve/http_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace dspm {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using std::chrono::seconds;

constexpr std::size_t kLongestHead = 16 << 10, kLongestBody = 64 << 10;
constexpr std::ptrdiff_t kMostHeaders = 100;
constexpr seconds kForRequest(10), kForAnswer(10), kForFarewell(1);
constexpr std::size_t kSlowest = 16 << 10;  // bytes of an answer a second

template <class Text>
std::string text_of(const Text& text) {
  return {text.data(), text.size()};
}

HttpRequest request_of(const http::request<http::string_body>& message) {
  const std::string target = text_of(message.target());
  return {text_of(message.method_string()),
          target.substr(0, target.find('?')),
          text_of(message[http::field::host]),
          text_of(message[http::field::origin]),
          text_of(message["Sec-Fetch-Site"]),
          text_of(message["Last-Event-ID"]),
          message.body()};
}

/// Returns why a request that has been let in has a body that is not read.
std::optional<HttpAnswer> refusal_of_body(const http::request<http::string_body>& message,
                                          const std::optional<std::uint64_t>& length) {
  if (message.count(http::field::content_encoding) > 0) return http_refusal(415, "bodies come as they are");
  if (message.count(http::field::transfer_encoding) > 0) return http_refusal(411, "bodies come with their length");
  if (length.value_or(0) > kLongestBody) return http_refusal(413, fmt::format("bodies have {} bytes", kLongestBody));
  return {};
}

}  // namespace

HttpAnswer http_refusal(int status, std::string_view reason) {
  return {status, "text/plain; charset=utf-8", fmt::format("{}\n", reason)};
}

std::optional<HttpConnection::Clock::time_point> HttpConnection::waits_since() const {
  const Clock::rep since = waits_since_;
  return since == kAnswers ? std::nullopt : std::optional(Clock::time_point(Clock::duration(since)));
}

void HttpConnection::serve(const HttpServer::Site& site, const std::atomic<bool>& closing) {
  buffer_.max_size(kLongestHead + kLongestBody);
  stream_.socket().set_option(net::ip::tcp::no_delay(true), error_);
  while (serve_one(site) && !closing) begin_waiting();
  begin_waiting();
  part();
}

void HttpConnection::begin_waiting() { waits_since_ = Clock::now().time_since_epoch().count(); }

/// Serves one request. The deadline holds for its head and its body together.
bool HttpConnection::serve_one(const HttpServer::Site& site) {
  Parser parser;
  stream_.expires_after(kForRequest);
  if (!read_head(parser, site)) return false;
  HttpRequest head = request_of(parser.get());
  if (std::optional<HttpAnswer> refusal = site.refusal(head)) return send(*std::move(refusal), site, parser, false);
  const auto length = parser.content_length();
  if (auto refusal = refusal_of_body(parser.get(), length ? std::optional(std::uint64_t{*length}) : std::nullopt))
    return send(*std::move(refusal), site, parser, false);
  if (!read_body(parser)) return false;
  waits_since_ = kAnswers;
  head.body = std::move(parser.get().body());
  return send(site.answer(head), site, parser, parser.keep_alive());
}

/// Reads the head. A line that does not end is refused like one that is too long.
bool HttpConnection::read_head(Parser& parser, const HttpServer::Site& site) {
  parser.header_limit(kLongestHead);
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // checked after the head has been let in
  const auto read = [&](auto done) { http::async_read_header(stream_, buffer_, parser, done); };
  if (!finish(read)) {
    if (error_ == http::error::header_limit || error_ == http::error::buffer_overflow)
      return parser.get().target().empty() ? refuse(414, "the address is too long", site, parser)
                                           : refuse(431, "the headers are too long", site, parser);
    const bool is_http = error_.category() == beast::error_code(http::error::bad_method).category() &&
                         error_ != http::error::end_of_stream && error_ != http::error::partial_message;
    return is_http && refuse(400, "this is not HTTP", site, parser);
  }
  const auto& fields = parser.get();
  if (std::distance(fields.begin(), fields.end()) > kMostHeaders)
    return refuse(431, "there are too many headers", site, parser);
  if (fields.count(http::field::host) > 1) return refuse(400, "there is more than one Host", site, parser);
  return true;
}

bool HttpConnection::read_body(Parser& parser) {
  if (parser.is_done()) return true;
  const std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";
  if (beast::iequals(parser.get()[http::field::expect], "100-continue") &&
      !finish([&](auto done) { net::async_write(stream_, net::buffer(go_on), done); }))
    return false;
  return finish([&](auto done) { http::async_read(stream_, buffer_, parser, done); });
}

bool HttpConnection::refuse(int status, std::string_view reason, const HttpServer::Site& site, const Parser& parser) {
  return send(http_refusal(status, reason), site, parser, false);
}

bool HttpConnection::send(HttpAnswer answer, const HttpServer::Site& site, const Parser& parser, bool stays) {
  const bool is_head = parser.get().method() == http::verb::head;
  http::response<http::string_body> message;
  message.result(static_cast<unsigned>(answer.status));
  for (const auto& [name, value] : site.headers) message.set(name, value);
  if (!answer.type.empty()) message.set(http::field::content_type, answer.type);
  message.keep_alive(stays && !answer.next);
  if (answer.next && !is_head) return send_texts(answer.next, message);
  message.body() = std::move(answer.body);
  message.prepare_payload();
  const std::size_t size = message.body().size();
  if (is_head) message.body().clear();
  stream_.expires_after(kForAnswer + seconds(size / kSlowest));
  return finish([&](auto done) { http::async_write(stream_, message, done); }) && message.keep_alive();
}

/// Sends texts, whose end is that of the connection.
bool HttpConnection::send_texts(const std::function<std::string()>& next, const http::response_header<>& head) {
  http::response<http::empty_body> message(head);
  http::response_serializer<http::empty_body> serializer(message);
  stream_.expires_after(kForAnswer);
  bool arrives = finish([&](auto done) { http::async_write_header(stream_, serializer, done); });
  while (arrives) {
    const std::string text = next();
    if (text.empty()) break;
    stream_.expires_after(kForAnswer);
    arrives = finish([&](auto done) { net::async_write(stream_, net::buffer(text), done); });
  }
  return false;
}

/// Reads on for a moment: whoever still sends would lose the answer if the connection were closed.
void HttpConnection::part() {
  beast::error_code ignored;
  stream_.socket().shutdown(Socket::shutdown_send, ignored);
  stream_.expires_after(kForFarewell);
  std::array<char, 4096> rest;
  while (finish([&](auto done) { stream_.async_read_some(net::buffer(rest), done); })) continue;
}

}  // namespace dspm
