#include "dspm/serve/server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "dspm/output/json.h"
#include "dspm/serve/page_files.h"
#include "dspm/serve/requests.h"

namespace dspm {
namespace {

using std::chrono::milliseconds;

// A viewer's connections each hold a thread: one for events, one that waits for pictures, others for a moment.
constexpr int kMostViewers = 16;
constexpr std::size_t kThreads = 3 * kMostViewers, kLongestBody = 64 << 10;
constexpr int kMostIterations = 1'000'000;
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
class Places {
 public:
  std::shared_ptr<void> take() {
    if (taken_.fetch_add(1) >= kMostViewers) return --taken_, nullptr;
    return {this, [](Places* places) { --places->taken_; }};
  }

 private:
  std::atomic<int> taken_ = 0;
};

void refuse(httplib::Response& response, int status, std::string_view reason) {
  response.status = status;
  response.set_content(fmt::format("{}\n", reason), "text/plain; charset=utf-8");
}

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

/// A line of text about each picture, then its bytes.
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
  Impl(const ServeAddress& address, Gallery& gallery_of_run, Board& board_of_run, Orders& orders_of_run)
      : gallery(gallery_of_run), board(board_of_run), orders(orders_of_run), access(address, open(address)) {
    http.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) { return let_in(request, response); });
    for (const PageFile& file : page_files()) serve(file);
    http.Get(path("run"), [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(board.run(), "application/json");
    });
    http.Get(path("events"), [this](const auto& request, auto& response) { send_events(request, response); });
    http.Post(path("pictures"), [this](const auto& request, auto& response) { send_pictures(request, response); });
    take_orders();
    listener = std::thread([this] {
      pthread_setname_np(pthread_self(), "dspm page");  // and so are the threads that it starts
      http.listen_after_bind(), ended = true;
    });
  }
  ~Impl() {
    board.close(), gallery.close();
    while (!http.is_running() && !ended) std::this_thread::sleep_for(milliseconds(1));
    http.stop();
    listener.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Returns the port.
  int open(const ServeAddress& address) {
    http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    http.set_payload_max_length(kLongestBody);
    http.set_keep_alive_max_count(1000), http.set_keep_alive_timeout(1);
    http.set_read_timeout(5), http.set_write_timeout(5), http.set_tcp_nodelay(true);
    // Not SO_REUSEPORT, which httplib sets: two runs must not share a port.
    http.set_socket_options([](int socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    const int port = address.port == 0                               ? http.bind_to_any_port(address.host)
                     : http.bind_to_port(address.host, address.port) ? address.port
                                                                     : -1;
    if (port < 0)
      throw std::runtime_error(fmt::format("--serve cannot listen at {}, port {}: is it taken? --serve 0 takes any",
                                           address.host, address.port));
    return port;
  }

  std::string path(const std::string& name) const { return access.prefix() + name; }

  httplib::Server::HandlerResponse let_in(const httplib::Request& request, httplib::Response& response) const {
    response.headers = {{"Content-Security-Policy", kPolicy},
                        {"X-Content-Type-Options", "nosniff"},
                        {"Cross-Origin-Resource-Policy", "same-origin"},
                        {"Referrer-Policy", "no-referrer"},
                        {"Cache-Control", "no-store"}};
    const std::string host = request.get_header_value("Host"), origin = request.get_header_value("Origin"),
                      site = request.get_header_value("Sec-Fetch-Site");
    const std::string_view refusal = access.refusal({host, origin, site, request.path});
    if (refusal.empty()) return httplib::Server::HandlerResponse::Unhandled;
    refuse(response, 403, refusal);
    return httplib::Server::HandlerResponse::Handled;
  }

  void serve(const PageFile& file) {
    const std::string name = file.name == "index.html" ? "" : std::string(file.name);
    http.Get(path(name), [file](const httplib::Request&, httplib::Response& response) {
      response.set_content(file.text.data(), file.text.size(), type_of(file.name));
    });
  }

  void send_events(const httplib::Request& request, httplib::Response& response) {
    const std::shared_ptr<void> place = viewers.take();
    if (place == nullptr) return refuse(response, 503, "too many pages are open");
    struct Known {
      std::uint64_t version = 0, line = 0;
    };
    const auto known = std::make_shared<Known>();
    known->line =
        static_cast<std::uint64_t>(parse_count(request.get_header_value("Last-Event-ID"), 0, 1 << 30).value_or(0));
    response.set_chunked_content_provider(
        "text/event-stream", [this, place, known](std::size_t, httplib::DataSink& sink) {
          const Board::News news = board.after(known->version, known->line, kHeartbeat);
          std::string text;
          if (!news.state.empty()) text += state_events(news);
          for (const Board::Line& line : news.lines) text += event_of(line), known->line = line.number;
          known->version = news.version;
          if (text.empty()) text = ":\n\n";  // finds out whether the viewer is still there
          if (!sink.write(text.data(), text.size())) return false;
          if (news.closed) return sink.done(), true;
          std::this_thread::sleep_for(kBetweenEvents);
          return true;
        });
  }

  void send_pictures(const httplib::Request& request, httplib::Response& response) {
    const auto wishes = parse_wishes(request.body);
    if (!wishes) return refuse(response, 400, "expected a number, then lines of: frame output halvings version other");
    const std::shared_ptr<void> place = waiting.take();
    if (place == nullptr) return refuse(response, 503, "too many pages are open");
    response.set_content(bundle_of(gallery.newer(*wishes, kPatience)), "application/octet-stream");
  }

  void take_order(const char* name, std::function<void()> order) {
    http.Post(path(name), [order = std::move(order)](const httplib::Request&, httplib::Response& response) {
      order();
      response.status = 204;
    });
  }
  void take_orders() {
    take_order("pause", [this] { orders.pause(true); });
    take_order("resume", [this] { orders.pause(false); });
    take_order("stop", [this] { orders.stop(); });
    take_order("write", [this] { orders.write(); });
    http.Post(path("more"), [this](const httplib::Request& request, httplib::Response& response) {
      const auto count = parse_count(request.body, 1, kMostIterations);
      if (!count) return refuse(response, 400, "expected a number of iterations");
      orders.add_iterations(*count);
      response.status = 204;
    });
    http.Post(path("camera"), [this](const httplib::Request& request, httplib::Response& response) {
      const auto place = parse_look_at(request.body);
      if (!place && !request.body.empty()) return refuse(response, 400, "expected nine numbers: eye, target, up");
      orders.place_camera(place);
      response.status = 204;
    });
  }

  Gallery& gallery;
  Board& board;
  Orders& orders;
  httplib::Server http;
  Access access;
  Places viewers, waiting;
  std::atomic<bool> ended = false;
  std::thread listener;
};

Server::Server(const ServeAddress& address, Gallery& gallery, Board& board, Orders& orders)
    : impl_(std::make_unique<Impl>(address, gallery, board, orders)) {}
Server::~Server() = default;

std::string Server::url() const { return impl_->access.url(); }

}  // namespace dspm
