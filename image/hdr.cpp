// Radiance's picture format: a text header, then rows of (red, green, blue, exponent) bytes, each row run-length
// encoded channel by channel. [Ward 1991, Real Pixels, Graphics Gems II; Radiance file formats, section "Picture
// files"]
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/decoders.h"
#include "dspm/image/image.h"

namespace dspm {

namespace {

using Row = std::vector<unsigned char>;  // width reds, then greens, blues, exponents

class HdrReader {
 public:
  explicit HdrReader(std::string_view bytes) : rest_(bytes) {}

  std::string_view line() {
    const std::size_t length = rest_.find('\n');
    if (length == std::string_view::npos) fail("the file ends within its header");
    const std::string_view text = rest_.substr(0, length);
    rest_.remove_prefix(length + 1);
    return text.ends_with('\r') ? text.substr(0, length - 1) : text;
  }

  void read_row(Row& row) {
    const std::size_t width = row.size() / 4;
    const bool encoded = width >= 8 && width < 32768 && rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 &&
                         static_cast<unsigned char>(rest_[2]) < 128;
    if (!encoded) return read_flat(row);
    for (int i = 0; i < 2; ++i) byte();
    const int high = byte(), low = byte();
    if (static_cast<std::size_t>(high << 8 | low) != width) fail("a row differs in width from the image");
    for (std::size_t channel = 0; channel < 4; ++channel) read_runs(row.data() + channel * width, width);
  }

  [[noreturn]] static void fail(const std::string& cause) { throw std::runtime_error(cause); }

 private:
  unsigned char byte() {
    if (rest_.empty()) fail("the file ends too early");
    const auto value = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }

  void read_flat(Row& row) {
    const std::size_t width = row.size() / 4;
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t channel = 0; channel < 4; ++channel) row[channel * width + x] = byte();
      // Mantissas are normalised, so 1 1 1 cannot be a colour: before 1991 it marked a run.
      if (row[x] == 1 && row[width + x] == 1 && row[2 * width + x] == 1)
        fail("its old run-length encoding is not supported");
    }
  }

  void read_runs(unsigned char* to, std::size_t left) {
    while (left > 0) {
      const std::size_t code = byte(), count = code > 128 ? code - 128 : code;
      if (count == 0 || count > left) fail("a run does not fit into its row");
      const unsigned char repeated = code > 128 ? byte() : static_cast<unsigned char>(0);
      for (std::size_t i = 0; i < count; ++i) *to++ = code > 128 ? repeated : byte();
      left -= count;
    }
  }

  std::string_view rest_;
};

/// Reads "-Y 512 +X 1024": rows from the top, each from the left. Other orders exist but are not written by anything
/// current.
Image image_of(std::string_view resolution, std::size_t file_bytes) {
  const std::size_t second = resolution.find(" +X ");
  if (!resolution.starts_with("-Y ") || second == std::string_view::npos) {
    HdrReader::fail("its rows are not ordered as -Y +X");
  }
  const auto number = [](std::string_view digits) {
    int value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && stop == digits.data() + digits.size() ? value : 0;
  };
  return sized_image(number(resolution.substr(second + 4)), number(resolution.substr(3, second - 3)), file_bytes);
}

/// Returns what the pixels have been multiplied by, as a line of the header says: "EXPOSURE=2" or "COLORCORR= 1 .9
/// 1.1". Several such lines multiply one another.
Rgb multiplier_of(std::string_view line) {
  const bool is_exposure = line.starts_with("EXPOSURE="), is_colour = line.starts_with("COLORCORR=");
  if (!is_exposure && !is_colour) return Rgb(1);
  std::istringstream values{std::string(line.substr(line.find('=') + 1))};
  Rgb factor(1);
  values >> factor.r;
  factor.g = factor.b = factor.r;
  if (is_colour) values >> factor.g >> factor.b;
  const bool is_sound =
      values && std::isfinite(factor.r * factor.g * factor.b) && factor.r > 0 && factor.g > 0 && factor.b > 0;
  if (!is_sound) HdrReader::fail("its header has no usable number in " + std::string(line.substr(0, 60)));
  return factor;
}

/// The exponent is biased by 128; the mantissa m stands for m / 256; exponent 0 is black.
Rgb color_of(unsigned char r, unsigned char g, unsigned char b, unsigned char exponent) {
  if (exponent == 0) return {};
  const float scale = std::ldexp(1.f, exponent - 136);
  return Rgb(r, g, b) * scale;
}

}  // namespace

bool is_hdr(std::string_view bytes) { return bytes.starts_with("#?RADIANCE") || bytes.starts_with("#?RGBE"); }

Image decode_hdr(std::string_view bytes) {
  HdrReader reader(bytes);
  Rgb applied(1);
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      HdrReader::fail("its colours are not RGB: " + std::string(line));
    }
    applied *= multiplier_of(line);
  }
  const Rgb radiance(1 / applied.r, 1 / applied.g, 1 / applied.b);
  Image image = image_of(reader.line(), bytes.size());
  const auto width = static_cast<std::size_t>(image.width);
  Row row(4 * width);
  for (int y = 0; y < image.height; ++y) {
    reader.read_row(row);
    for (std::size_t x = 0; x < width; ++x) {
      image.at(static_cast<int>(x), y) =
          color_of(row[x], row[width + x], row[2 * width + x], row[3 * width + x]) * radiance;
    }
  }
  return image;
}

}  // namespace dspm
