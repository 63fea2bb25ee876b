// Shows images as they get better, in tev's window.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/looking/packet_sender.h"

namespace dspm {

class DisplayServer {
 public:
  /// Takes "localhost:14158"; the host may be left out. Throws std::runtime_error if there is no port.
  explicit DisplayServer(const std::string& address);

  /// Returns whether it can take images now.
  bool is_ready() const { return sender_.is_idle(); }
  /// Sends the regions that have changed since the last time. `channels` are one to three, of the pixels' r, g and b.
  void show(const std::string& name, const Image& image, const std::vector<std::string>& channels);
  /// Returns why there are no images, once; empty if all is well, or if it has been reported.
  std::string take_fault() { return sender_.take_fault(); }

 private:
  /// Digests of what the server has of each region; empty if it has nothing.
  struct Sent {
    std::vector<std::size_t> regions;
  };
  PacketSender sender_;
  int connection_ = 0;
  std::map<std::string, Sent> sent_;
};

/// Returns the host (localhost if it is missing) and port of "host:port", "[::1]:port" or ":port". Throws
/// std::runtime_error.
std::pair<std::string, std::string> host_and_port(const std::string& address);

}  // namespace dspm
