// The Quite OK Image format. [Szablewski, The Quite OK Image Format, Specification 1.0, 2022]
#include <array>
#include <stdexcept>

#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/samples.h"

namespace dspm {

namespace {

using Pixel = std::array<unsigned char, 4>;  // red, green, blue, alpha

std::size_t slot(const Pixel& p) { return (p[0] * 3u + p[1] * 5u + p[2] * 7u + p[3] * 11u) % 64; }

class QoiReader {
 public:
  explicit QoiReader(std::string_view bytes) : rest_(bytes) {}

  unsigned byte() {
    if (rest_.empty()) throw std::runtime_error("the file ends too early");
    const auto value = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  std::int64_t number() {
    std::int64_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return value;
  }

  Pixel next_pixel() {
    if (run_ > 0) return --run_, pixel_;
    const unsigned tag = byte(), low = tag & 63;
    if (tag >= 254) {
      for (std::size_t c = 0; c < (tag == 255 ? 4u : 3u); ++c) pixel_[c] = static_cast<unsigned char>(byte());
    } else if (tag >= 192) {
      run_ = low;  // one less than the length, and this pixel is the first
    } else if (tag >= 128) {
      const unsigned green = low - 32, more = byte();
      add(green + (more >> 4) - 8, green, green + (more & 15) - 8);
    } else if (tag >= 64) {
      add((low >> 4) - 2, (low >> 2 & 3) - 2, (low & 3) - 2);
    } else {
      pixel_ = seen_[low];
    }
    seen_[slot(pixel_)] = pixel_;
    return pixel_;
  }

 private:
  void add(unsigned red, unsigned green, unsigned blue) {  // modulo 256
    pixel_[0] = static_cast<unsigned char>(pixel_[0] + red);
    pixel_[1] = static_cast<unsigned char>(pixel_[1] + green);
    pixel_[2] = static_cast<unsigned char>(pixel_[2] + blue);
  }

  std::string_view rest_;
  Pixel pixel_{0, 0, 0, 255};
  std::array<Pixel, 64> seen_{};
  unsigned run_ = 0;
};

}  // namespace

bool is_qoi(std::string_view bytes) { return bytes.starts_with("qoif"); }

Image decode_qoi(std::string_view bytes, ColorEncoding encoding) {
  QoiReader reader(bytes.substr(4));
  const std::int64_t width = reader.number(), height = reader.number();
  reader.byte();  // the number of channels informs only: the pixels are the same
  const bool linear = reader.byte() == 1;
  Image image = sized_image(width, height, bytes.size());
  std::vector<unsigned char> samples;
  samples.reserve(4 * image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Pixel pixel = reader.next_pixel();
    samples.insert(samples.end(), pixel.begin(), pixel.end());
  }
  if (linear && encoding.kind == ColorEncoding::Kind::automatic) encoding.kind = ColorEncoding::Kind::linear;
  set_pixels<unsigned char>(image, samples, 4, decoding_table(encoding, 256));
  return image;
}

}  // namespace dspm
