#include "dspm/looking/tev_packets.h"

#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace dspm {
namespace {

class Packet {
 public:
  explicit Packet(TevMessage type) {
    integer(std::uint32_t{0});  // the length, known at the end
    bytes_.push_back(static_cast<char>(type));
  }
  void flag(bool value) { bytes_.push_back(value ? 1 : 0); }
  void text(std::string_view value) {
    bytes_ += value;
    bytes_.push_back('\0');
  }
  void integer(std::integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
  std::string finished() {
    for (std::size_t i = 0; i < 4; ++i) bytes_[i] = static_cast<char>(bytes_.size() >> (8 * i) & 0xff);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

constexpr bool kFocus = false;  // the viewer goes on showing what it shows

}  // namespace

std::string tev_create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels) {
  Packet packet(TevMessage::create_image);
  packet.flag(kFocus);
  packet.text(name);
  packet.integer(width), packet.integer(height), packet.integer(static_cast<std::int32_t>(channels.size()));
  for (const std::string& channel : channels) packet.text(channel);
  return packet.finished();
}

std::string tev_update_image(const std::string& name, const PixelRect& where, const std::vector<std::string>& channels,
                             const std::vector<float>& values) {
  Packet packet(TevMessage::update_image_v3);
  packet.flag(kFocus);
  packet.text(name);
  packet.integer(static_cast<std::int32_t>(channels.size()));
  for (const std::string& channel : channels) packet.text(channel);
  for (const int number : {where.x0, where.y0, where.width(), where.height()}) packet.integer(number);
  for (std::size_t c = 0; c < channels.size(); ++c) packet.integer(static_cast<std::int64_t>(c));  // offsets
  for (std::size_t c = 0; c < channels.size(); ++c)
    packet.integer(static_cast<std::int64_t>(channels.size()));  // strides
  for (const float value : values) packet.integer(std::bit_cast<std::uint32_t>(value));
  return packet.finished();
}

std::string tev_close_image(const std::string& name) {
  Packet packet(TevMessage::close_image);
  packet.text(name);
  return packet.finished();
}

}  // namespace dspm
