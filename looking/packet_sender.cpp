#include "dspm/looking/packet_sender.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace dspm {
namespace {

constexpr int kMoment = 50;          // milliseconds
constexpr int kConnectMoments = 60;  // until a server counts as not there
constexpr std::chrono::seconds kBetweenTries{2}, kLastGrace{2};

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

std::string in_words(int error) { return std::generic_category().message(error); }

/// Waits until the socket can be written to, but only for a moment. Returns false if it cannot yet.
bool is_writable(int socket) {
  pollfd one{socket, POLLOUT, 0};
  return poll(&one, 1, kMoment) > 0;
}

/// Returns whether the server is gone. Servers of this protocol send nothing: what can be read is their end.
bool has_vanished(int socket) {
  char byte;
  const ssize_t count = recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
}

}  // namespace

PacketSender::PacketSender(std::string host, std::string port) : host_(std::move(host)), port_(std::move(port)) {
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& error) {
    throw std::runtime_error("no thread can be started: " + error.code().message());
  }
}

PacketSender::~PacketSender() {
  {
    const std::lock_guard lock(mutex_);
    deadline_ = Clock::now() + kLastGrace;
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool PacketSender::is_idle() const {
  const std::lock_guard lock(mutex_);
  return is_connected_ && queue_.empty();
}

void PacketSender::send(std::string packet, int connection) {
  const std::lock_guard lock(mutex_);
  if (!is_connected_ || connection != connection_) return;
  queue_.push_back(std::move(packet));
  changed_.notify_all();
}

std::string PacketSender::take_fault() {
  const std::lock_guard lock(mutex_);
  if (fault_ == told_) return "";
  return told_ = fault_;
}

void PacketSender::run() {
  while (!ended_) {
    const int socket = connected();
    if (socket >= 0) {
      serve(socket);
      close(socket);
    }
    std::unique_lock lock(mutex_);
    is_connected_ = false;
    queue_.clear();
    changed_.wait_for(lock, kBetweenTries, [this] { return ended_.load(); });
  }
}

int PacketSender::connected() {
  const auto fail = [&](const std::string& fault) {
    const std::lock_guard lock(mutex_);
    fault_ = fault;
    return -1;
  };
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (const int error = getaddrinfo(host_.c_str(), port_.c_str(), &hints, &found)) return fail(gai_strerror(error));
  const Addresses addresses(found, &freeaddrinfo);
  std::string fault = "no address";
  for (const addrinfo* each = found; each != nullptr && !ended_; each = each->ai_next) {
    const int socket = ::socket(each->ai_family, each->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol);
    if (socket < 0) continue;
    int error = connect(socket, each->ai_addr, each->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      error = ETIMEDOUT;
      socklen_t size = sizeof error;
      for (int i = 0; i < kConnectMoments && !ended_; ++i)
        if (is_writable(socket)) {
          getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
          break;
        }
    }
    if (error == 0) return socket;
    fault = in_words(error);
    close(socket);
  }
  return fail(fault);
}

void PacketSender::serve(int socket) {
  std::unique_lock lock(mutex_);
  is_connected_ = true, ++connection_;
  fault_.clear(), told_.clear();
  for (std::size_t sent = 0; !ends();) {
    if (queue_.empty()) {
      changed_.wait_for(lock, std::chrono::milliseconds(10 * kMoment));
      if (has_vanished(socket)) break;
      continue;
    }
    const std::string& packet = queue_.front();  // stays where it is as others are added
    lock.unlock();
    ssize_t count = -1;
    errno = EAGAIN;
    if (is_writable(socket))
      count = ::send(socket, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    const int error = errno;
    lock.lock();
    if (count < 0 && error != EAGAIN && error != EINTR) break;
    if (count > 0) sent += static_cast<std::size_t>(count);
    if (sent == packet.size()) queue_.pop_front(), sent = 0;
  }
  is_connected_ = false;
  if (!ended_) fault_ = "the connection has ended";
}

}  // namespace dspm
