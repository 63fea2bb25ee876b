// A server that reads tev's protocol as tev does. [github.com/Tom94/tev, Ipc.h: IStream; Ipc.cpp: interpretAs...]
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dspm::test {

/// An image as the viewer has it: planes of values by channel.
struct TevImage {
  int width = 0, height = 0, updates = 0;
  std::map<std::string, std::vector<float>> planes;
};

class TevServer {
 public:
  /// `slow`: accepts, and reads nothing. `port` 0: any.
  explicit TevServer(bool slow = false, int port = 0) : slow_(slow), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    const int yes = 1;
    setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener_, 4) != 0)
      throw std::runtime_error("no port");
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~TevServer() { stop(); }
  TevServer(const TevServer&) = delete;
  TevServer& operator=(const TevServer&) = delete;

  void stop() {
    if (ended_.exchange(true)) return;
    thread_.join();
    close(listener_);
  }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  int port() const { return port_; }
  std::map<std::string, TevImage> images() const {
    const std::lock_guard lock(mutex_);
    return images_;
  }
  /// What a packet did wrong; empty: nothing.
  std::string fault() const {
    const std::lock_guard lock(mutex_);
    return fault_;
  }

 private:
  class Reader {
   public:
    explicit Reader(const std::string& packet) : rest_(packet) {
      if (number<std::uint32_t>() != packet.size()) throw std::runtime_error("incorrect size");
    }
    template <class T>
    T number() {
      if (rest_.size() < sizeof(T)) throw std::runtime_error("beyond the packet");
      T value;
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.erase(0, sizeof value);
      return value;
    }
    std::string text() {
      const std::size_t end = rest_.find('\0');
      if (end == rest_.npos) throw std::runtime_error("a text without an end");
      const std::string value = rest_.substr(0, end);
      rest_.erase(0, end + 1);
      return value;
    }
    const std::string& rest() const { return rest_; }

   private:
    std::string rest_;
  };

  void run() {
    while (!ended_) {
      if (!readable(listener_)) continue;
      const int client = accept(listener_, nullptr, nullptr);
      std::string bytes;
      while (!ended_ && client >= 0) {
        if (slow_ || !readable(client)) {
          if (slow_) usleep(10'000);
          continue;
        }
        char part[65536];
        const ssize_t count = read(client, part, sizeof part);
        if (count <= 0) break;
        bytes.append(part, static_cast<std::size_t>(count));
        take_packets(bytes);
      }
      close(client);
    }
  }
  static bool readable(int descriptor) {
    pollfd one{descriptor, POLLIN, 0};
    return poll(&one, 1, 20) > 0;
  }
  void take_packets(std::string& bytes) {
    for (std::uint32_t size; bytes.size() >= sizeof size;) {
      std::memcpy(&size, bytes.data(), sizeof size);
      if (bytes.size() < size) return;
      const std::lock_guard lock(mutex_);
      try {
        take(bytes.substr(0, size));
      } catch (const std::runtime_error& error) {
        fault_ = error.what();
      }
      bytes.erase(0, size);
    }
  }
  void take(const std::string& packet) {
    Reader reader(packet);
    const int type = reader.number<char>();
    if (type == 2) {
      images_.erase(reader.text());
    } else if (type == 4) {
      create(reader);
    } else if (type == 6) {
      update(reader);
    } else {
      throw std::runtime_error("unknown type");
    }
  }
  void create(Reader& reader) {
    reader.number<bool>();
    const std::string name = reader.text();
    TevImage image;
    image.width = reader.number<std::int32_t>(), image.height = reader.number<std::int32_t>();
    for (int left = reader.number<std::int32_t>(); left > 0; --left)
      image.planes[reader.text()].resize(static_cast<std::size_t>(image.width * image.height));
    if (!reader.rest().empty()) throw std::runtime_error("too long");
    images_[name] = image;
  }
  void update(Reader& reader) {
    reader.number<bool>();
    TevImage& image = images_.at(reader.text());
    ++image.updates;
    std::vector<std::string> channels(static_cast<std::size_t>(reader.number<std::int32_t>()));
    for (std::string& channel : channels) channel = reader.text();
    const int x = reader.number<std::int32_t>(), y = reader.number<std::int32_t>(),
              width = reader.number<std::int32_t>(), height = reader.number<std::int32_t>();
    std::vector<std::int64_t> offsets(channels.size()), strides(channels.size());
    for (std::int64_t& offset : offsets) offset = reader.number<std::int64_t>();
    for (std::int64_t& stride : strides) stride = reader.number<std::int64_t>();
    if (x < 0 || y < 0 || x + width > image.width || y + height > image.height) throw std::runtime_error("outside");
    const std::string& data = reader.rest();
    for (std::size_t c = 0; c < channels.size(); ++c)
      for (int pixel = 0; pixel < width * height; ++pixel) {
        const auto at = static_cast<std::size_t>(offsets[c] + pixel * strides[c]) * sizeof(float);
        if (at + sizeof(float) > data.size()) throw std::runtime_error("insufficient image data");
        const int to = (y + pixel / width) * image.width + x + pixel % width;
        std::memcpy(&image.planes.at(channels[c])[static_cast<std::size_t>(to)], data.data() + at, sizeof(float));
      }
  }

  bool slow_;
  int listener_, port_ = 0;
  mutable std::mutex mutex_;
  std::map<std::string, TevImage> images_;
  std::string fault_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace dspm::test
