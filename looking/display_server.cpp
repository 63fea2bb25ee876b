#include "dspm/looking/display_server.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/film/pixel_rect.h"
#include "dspm/looking/tev_packets.h"

namespace dspm {
namespace {

constexpr int kRegion = 128;  // pixels along a side, as pbrt's

std::vector<PixelRect> regions_of(const Image& image) {
  std::vector<PixelRect> regions;
  for (int y = 0; y < image.height; y += kRegion)
    for (int x = 0; x < image.width; x += kRegion)
      regions.push_back({x, y, std::min(x + kRegion, image.width), std::min(y + kRegion, image.height)});
  return regions;
}

std::vector<float> values_within(const Image& image, const PixelRect& where, int channels) {
  std::vector<float> values;
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x)
      for (int c = 0; c < channels; ++c) values.push_back(image.at(x, y)[c]);
  return values;
}

/// Returns a digest that is never 0, which means that nothing was sent.
std::size_t digest(const std::vector<float>& values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return std::hash<std::string_view>()(bytes) | 1;
}

}  // namespace

std::pair<std::string, std::string> host_and_port(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const std::string port = colon == address.npos ? "" : address.substr(colon + 1);
  if (port.empty() || port.size() > 5 || port.find_first_not_of("0123456789") != port.npos || std::stoi(port) > 65535)
    throw std::runtime_error("expected host:port, such as localhost:14158");
  std::string host = address.substr(0, colon);
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {host.empty() ? "localhost" : host, port};
}

DisplayServer::DisplayServer(const std::string& address)
    : sender_(host_and_port(address).first, host_and_port(address).second) {}

void DisplayServer::show(const std::string& name, const Image& image, const std::vector<std::string>& channels) {
  const int connection = sender_.connection();
  if (std::exchange(connection_, connection) != connection) sent_.clear();
  if (connection == 0) return;
  Sent& sent = sent_[name];
  const std::vector<PixelRect> regions = regions_of(image);
  if (sent.regions.size() != regions.size()) {
    sender_.send(tev_close_image(name), connection);  // that of an earlier run
    sender_.send(tev_create_image(name, image.width, image.height, channels), connection);
    sent.regions.assign(regions.size(), 0);
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::vector<float> values = values_within(image, regions[i], static_cast<int>(channels.size()));
    const std::size_t now = digest(values);
    if (std::exchange(sent.regions[i], now) == now) continue;
    sender_.send(tev_update_image(name, regions[i], channels, values), connection);
  }
}

}  // namespace dspm
