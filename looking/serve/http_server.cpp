#include "dspm/looking/serve/http_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "dspm/looking/serve/http_connection.h"

namespace dspm {
namespace {

namespace net = boost::asio;
using net::ip::tcp;
using std::chrono::milliseconds;

// A viewer's connections each hold a thread: one for events, one that waits for pictures, others for a moment.
constexpr std::size_t kMostConnections = 48;
constexpr milliseconds kForFarewells(1000), kAfterFailure(50);

/// Keeps connections from programs that dspm starts.
void keep_from_programs(int descriptor) { fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

}  // namespace

struct HttpServer::Impl {
  struct Served {
    std::shared_ptr<HttpConnection> connection;
    std::thread thread = {};
    bool is_over = false;
  };

  Impl(const std::string& host, int port) {
    const tcp::endpoint place(net::ip::make_address(host == "localhost" ? "127.0.0.1" : host),
                              static_cast<unsigned short>(port));
    acceptor.open(place.protocol());
    keep_from_programs(acceptor.native_handle());
    acceptor.set_option(tcp::acceptor::reuse_address(true));
    acceptor.bind(place);
    acceptor.listen();
  }
  ~Impl() { end(); }

  void end() {
    if (!listener.joinable()) return;
    is_closing = true;
    net::post(context, [this] { acceptor.close(); });
    changed.notify_all();
    listener.join();
    std::unique_lock lock(mutex);
    for (const Served& each : served)
      if (each.connection->waits_since()) each.connection->end();
    changed.wait_for(lock, kForFarewells, [this] { return all_over(); });
    for (const Served& each : served) each.connection->end();
    lock.unlock();
    for (Served& each : served) each.thread.join();
    served.clear();
  }

  bool all_over() const {
    return std::all_of(served.begin(), served.end(), [](const Served& each) { return each.is_over; });
  }

  void listen() {
    pthread_setname_np(pthread_self(), "dspm page");  // and so are the threads that it starts
    while (!is_closing) {
      make_room();
      const auto connection = std::make_shared<HttpConnection>();
      boost::beast::error_code error;
      acceptor.async_accept(connection->socket(), [&](boost::beast::error_code outcome) { error = outcome; });
      context.restart();
      context.run();
      if (error || !begin(connection)) std::this_thread::sleep_for(kAfterFailure);  // it may be short of files
    }
  }

  /// Returns false if there are no more threads.
  bool begin(const std::shared_ptr<HttpConnection>& connection) try {
    keep_from_programs(connection->socket().native_handle());
    const std::lock_guard lock(mutex);
    Served& place = served.emplace_back(Served{connection});
    try {
      place.thread = std::thread([this, &place] { run(place); });
    } catch (...) {
      served.pop_back();
      throw;
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }

  void run(Served& place) {
    try {
      place.connection->serve(site, is_closing);
    } catch (const std::exception&) {  // there is no memory: the connection ends
    }
    place.connection->close();
    const std::lock_guard lock(mutex);
    place.is_over = true;
    changed.notify_all();
  }

  /// Closes, if need be, the connection that has waited longest for its other side, so that nobody can merely hold a
  /// place.
  void make_room() {
    std::unique_lock lock(mutex);
    while (!is_closing) {
      served.remove_if([](Served& each) {
        if (each.is_over) each.thread.join();
        return each.is_over;
      });
      if (served.size() < kMostConnections) return;
      const auto since = [](const Served& each) {
        return each.connection->waits_since().value_or(HttpConnection::Clock::time_point::max());
      };
      const auto longest = std::min_element(served.begin(), served.end(),
                                            [&](const Served& a, const Served& b) { return since(a) < since(b); });
      if (longest->connection->waits_since()) longest->connection->end();
      changed.wait_for(lock, kAfterFailure);
    }
  }

  net::io_context context{1};
  tcp::acceptor acceptor{context};
  Site site;
  std::atomic<bool> is_closing = false;
  std::mutex mutex;
  std::condition_variable changed;
  std::list<Served> served;
  std::thread listener;
};

HttpServer::HttpServer(const std::string& host, int port) try : impl_(std::make_unique<Impl>(host, port)) {
} catch (const boost::system::system_error& error) {
  throw std::runtime_error(
      fmt::format("--serve cannot listen at {}, port {}: {}; --serve 0 takes any port that is free", host, port,
                  error.code().message()));
}
HttpServer::~HttpServer() = default;

int HttpServer::port() const { return impl_->acceptor.local_endpoint().port(); }

void HttpServer::serve(Site site) {
  impl_->site = std::move(site);
  impl_->listener = std::thread([impl = impl_.get()] { impl->listen(); });
}

void HttpServer::end() { impl_->end(); }

}  // namespace dspm
