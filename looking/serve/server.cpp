#include "dspm/looking/serve/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "dspm/base/system/json.h"
#include "dspm/looking/serve/http_server.h"
#include "dspm/looking/serve/page_files.h"
#include "dspm/looking/serve/requests.h"

namespace dspm {
namespace {

using std::chrono::milliseconds;

constexpr int kMostViewers = 16, kMostIterations = 1'000'000;
constexpr milliseconds kPatience(10'000), kHeartbeat(2'000), kBetweenEvents(100);

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

const char* type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

/// Counts those who hold a thread for long.
class Seats {
 public:
  std::shared_ptr<void> take() {
    if (taken_.fetch_add(1) >= kMostViewers) return --taken_, nullptr;
    return {this, [](Seats* seats) { --seats->taken_; }};
  }

 private:
  std::atomic<int> taken_ = 0;
};

const HttpAnswer kDone{204};

std::string event_of(const Board::Line& line) {
  JsonWriter json;
  json.value(line.text);
  return fmt::format("event: line\nid: {}\ndata: {}\n\n", line.number, json.text());
}

std::string state_events(const Board::News& news) {
  JsonWriter problem;
  problem.value(news.problem);
  return fmt::format("event: state\ndata: {}\n\nevent: problem\ndata: {}\n\n", news.state, problem.text());
}

/// Returns a line of text about each picture, then its bytes.
std::string bundle_of(const Gallery::Pictures& pictures) {
  std::string bundle;
  for (const auto& picture : pictures) {
    const Picture& p = *picture;
    bundle +=
        fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", p.wish.frame, p.wish.output, p.wish.halvings, p.version,
                    p.width, p.height, p.channels, p.bytes, p.iterations, p.coarse ? 1 : 0, p.run, p.pixels.size());
    bundle += p.pixels;
  }
  return bundle;
}

}  // namespace

struct Server::Impl {
  using Handler = std::function<HttpAnswer(const HttpRequest&)>;

  Impl(const ServeAddress& address, Gallery& gallery_of_run, Board& board_of_run, Orders& orders_of_run)
      : gallery(gallery_of_run),
        board(board_of_run),
        orders(orders_of_run),
        http(address.host, address.port),
        access(address, http.port()) {
    for (const PageFile& file : page_files()) serve(file);
    get["run"] = [this](const HttpRequest&) { return HttpAnswer{200, "application/json", board.run()}; };
    get["events"] = [this](const HttpRequest& request) { return events(request); };
    post["pictures"] = [this](const HttpRequest& request) { return pictures(request); };
    take_orders();
    http.serve({{{"Content-Security-Policy", kPolicy},
                 {"X-Content-Type-Options", "nosniff"},
                 {"Cross-Origin-Resource-Policy", "same-origin"},
                 {"Referrer-Policy", "no-referrer"},
                 {"Cache-Control", "no-store"}},
                [this](const HttpRequest& head) { return refusal(head); },
                [this](const HttpRequest& request) { return answer(request); }});
  }
  ~Impl() { board.close(), gallery.close(), http.end(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::optional<HttpAnswer> refusal(const HttpRequest& head) const {
    const std::string_view why = access.refusal({head.host, head.origin, head.fetch_site, head.path});
    if (why.empty()) return {};
    return http_refusal(403, why);
  }

  HttpAnswer answer(const HttpRequest& request) const {
    const bool is_get = request.method == "GET" || request.method == "HEAD";
    const auto& handlers = is_get ? get : post;
    const auto found = handlers.find(request.path.substr(access.prefix().size()));
    if (found == handlers.end() || (!is_get && request.method != "POST"))
      return http_refusal(404, "there is no such page");
    return found->second(request);
  }

  void serve(const PageFile& file) {
    get[file.name == "index.html" ? "" : std::string(file.name)] = [file](const HttpRequest&) {
      return HttpAnswer{200, type_of(file.name), std::string(file.text)};
    };
  }

  HttpAnswer events(const HttpRequest& request) {
    const std::shared_ptr<void> place = viewers.take();
    if (place == nullptr) return http_refusal(503, "too many pages are open");
    const int last_line = parse_count(request.last_event, 0, 1 << 30).value_or(0);
    HttpAnswer answer{200, "text/event-stream"};
    answer.next = [this, place, version = std::uint64_t{0}, line = static_cast<std::uint64_t>(last_line),
                   is_closed = false, is_first = true]() mutable -> std::string {
      if (is_closed) return {};
      if (!std::exchange(is_first, false)) std::this_thread::sleep_for(kBetweenEvents);
      const Board::News news = board.after(version, line, kHeartbeat);
      std::string text;
      if (!news.state.empty()) text += state_events(news);
      for (const Board::Line& each : news.lines) text += event_of(each), line = each.number;
      version = news.version, is_closed = news.closed;
      return text.empty() ? ":\n\n" : text;  // finds out whether the viewer is still there
    };
    return answer;
  }

  HttpAnswer pictures(const HttpRequest& request) {
    const auto wishes = parse_wishes(request.body);
    if (!wishes) return http_refusal(400, "expected a number, then lines of: frame output halvings version other");
    const std::shared_ptr<void> place = waiting.take();
    if (place == nullptr) return http_refusal(503, "too many pages are open");
    return {200, "application/octet-stream", bundle_of(gallery.newer(*wishes, kPatience))};
  }

  void take_order(const char* name, std::function<void()> order) {
    post[name] = [order = std::move(order)](const HttpRequest&) { return order(), kDone; };
  }
  void take_orders() {
    take_order("pause", [this] { orders.pause(true); });
    take_order("resume", [this] { orders.pause(false); });
    take_order("stop", [this] { orders.stop(); });
    take_order("write", [this] { orders.write(); });
    post["more"] = [this](const HttpRequest& request) {
      const auto count = parse_count(request.body, 1, kMostIterations);
      if (!count) return http_refusal(400, "expected a number of iterations");
      if (!orders.add_iterations(*count)) return http_refusal(409, "a run cannot have so many iterations");
      return kDone;
    };
    post["camera"] = [this](const HttpRequest& request) {
      const auto place = parse_look_at(request.body);
      if (!place && !request.body.empty()) return http_refusal(400, "expected nine numbers: eye, target, up");
      return orders.place_camera(place), kDone;
    };
  }

  Gallery& gallery;
  Board& board;
  Orders& orders;
  Seats viewers, waiting;
  std::map<std::string, Handler> get, post;  // by what follows the token
  HttpServer http;
  Access access;
};

Server::Server(const ServeAddress& address, Gallery& gallery, Board& board, Orders& orders)
    : impl_(std::make_unique<Impl>(address, gallery, board, orders)) {}
Server::~Server() = default;

std::string Server::url() const { return impl_->access.url(); }

}  // namespace dspm
