// Netpbm's formats: a header of words, then numbers as text or in binary. PFM is their floating-point relative.
// [Netpbm manual, pages pbm, pgm, ppm, pam, pfm]
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"

namespace dspm {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

class NetpbmReader {
 public:
  explicit NetpbmReader(std::string_view bytes) : rest_(bytes) {}

  /// Reads up to the next space; comments run from # to the end of the line.
  std::string_view word() {
    while (!rest_.empty() && (is_space(rest_.front()) || rest_.front() == '#')) {
      const std::size_t gone = rest_.front() == '#' ? rest_.find_first_of("\r\n") : 0;
      rest_.remove_prefix(gone == std::string_view::npos ? rest_.size() : gone + 1);
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_space(rest_[length]) && rest_[length] != '#') ++length;
    if (length == 0) fail("the file ends too early");
    const std::string_view found = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return found;
  }

  template <class Number>
  Number number() {
    const std::string_view digits = word();
    Number value{};
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size()) {
      fail("a number was expected, not \"" + std::string(digits.substr(0, 20)) + "\"");
    }
    return value;
  }

  /// Reads a bit of P1, which needs no space between bits.
  int digit() {
    const std::string_view found = word();
    rest_ = {found.data() + 1, static_cast<std::size_t>(rest_.data() + rest_.size() - found.data() - 1)};
    if (found.front() != '0' && found.front() != '1') fail("a bit is neither 0 nor 1");
    return found.front() - '0';
  }

  /// Returns what follows the header's last word and one space.
  std::string_view data(std::size_t count) {
    if (rest_.empty() || count > rest_.size() - 1) fail("the file ends too early");
    return rest_.substr(1, count);
  }

  [[noreturn]] static void fail(const std::string& cause) { throw std::runtime_error(cause); }

 private:
  std::string_view rest_;
};

void read_bits(NetpbmReader& reader, Image& image, bool text) {
  const auto width = static_cast<std::size_t>(image.width), row_bytes = (width + 7) / 8;
  const std::string_view data =
      text ? std::string_view() : reader.data(row_bytes * static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t x = i % width;
    const bool black = text ? reader.digit() == 1
                            : (static_cast<unsigned char>(data[i / width * row_bytes + x / 8]) >> (7 - x % 8) & 1) != 0;
    image.pixels[i] = Rgb(black ? 0.f : 1.f);
  }
}

/// Reads 1 channel as grey, 2 as grey and alpha, 3 as RGB, 4 as RGB and alpha.
void read_numbers(NetpbmReader& reader, Image& image, bool text, int channels, int most, ColorEncoding encoding) {
  if (most < 1 || most > 65535) NetpbmReader::fail("its largest value is not in 1..65535");
  const bool grey = channels < 3, has_alpha = channels % 2 == 0;
  const std::vector<float> linear = decoding_table(encoding, most + 1);
  const std::size_t bytes = most > 255 ? 2 : 1, count = image.pixels.size() * static_cast<std::size_t>(channels);
  const std::string_view data = text ? std::string_view() : reader.data(count * bytes);
  std::size_t at = 0;
  const auto next = [&] {
    std::int64_t value = 0;
    if (text) value = reader.number<std::int64_t>();
    for (std::size_t i = 0; !text && i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(data[at++]);
    if (value < 0 || value > most) NetpbmReader::fail("a value exceeds the largest that its header names");
    return static_cast<std::size_t>(value);
  };
  for (Rgb& pixel : image.pixels) {
    pixel = Rgb(linear[next()]);
    if (!grey) pixel.g = linear[next()], pixel.b = linear[next()];
    if (has_alpha) image.alpha.push_back(static_cast<float>(next()) / static_cast<float>(most));
  }
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 1; })) image.alpha.clear();
}

/// Reads P7, whose header has its lines in any order.
Image decode_pam(NetpbmReader& reader, std::size_t file_bytes, ColorEncoding encoding) {
  constexpr std::string_view kTypes[] = {"BLACKANDWHITE",       "GRAYSCALE",       "RGB",
                                         "BLACKANDWHITE_ALPHA", "GRAYSCALE_ALPHA", "RGB_ALPHA"};
  std::int64_t width = 0, height = 0;
  int channels = 0, most = 0;
  for (std::string_view word = reader.word(); word != "ENDHDR"; word = reader.word()) {
    if (word == "WIDTH")
      width = reader.number<std::int64_t>();
    else if (word == "HEIGHT")
      height = reader.number<std::int64_t>();
    else if (word == "DEPTH")
      channels = reader.number<int>();
    else if (word == "MAXVAL")
      most = reader.number<int>();
    else if (word != "TUPLTYPE")
      NetpbmReader::fail("its header has a line that is not known");
    else if (std::find(std::begin(kTypes), std::end(kTypes), reader.word()) == std::end(kTypes))
      NetpbmReader::fail("its TUPLTYPE is neither grey nor RGB");
  }
  if (channels < 1 || channels > 4) NetpbmReader::fail("its DEPTH is not in 1..4");
  Image image = sized_image(width, height, file_bytes);
  read_numbers(reader, image, false, channels, most, encoding);
  return image;
}

}  // namespace

bool is_pnm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
         (is_space(bytes[2]) || bytes[2] == '#');
}

Image decode_pnm(std::string_view bytes, ColorEncoding encoding) {
  NetpbmReader reader(bytes);
  const int kind = reader.word()[1] - '0';
  if (kind == 7) return decode_pam(reader, bytes.size(), encoding);
  const auto width = reader.number<std::int64_t>(), height = reader.number<std::int64_t>();
  Image image = sized_image(width, height, bytes.size());
  const bool text = kind <= 3;
  if (kind == 1 || kind == 4) {
    read_bits(reader, image, text);
  } else {
    const int most = reader.number<int>();
    read_numbers(reader, image, text, kind == 2 || kind == 5 ? 1 : 3, most, encoding);
  }
  return image;
}

bool is_pfm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') && is_space(bytes[2]);
}

/// Reads rows from the bottom; the scale's sign is the order of bytes: negative for the least significant first.
Image decode_pfm(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little);
  NetpbmReader reader(bytes);
  const bool grey = reader.word() == "Pf";
  const auto width = reader.number<std::int64_t>(), height = reader.number<std::int64_t>();
  const float scale = reader.number<float>();
  if (scale == 0 || !std::isfinite(scale)) NetpbmReader::fail("its scale is zero or not finite");
  Image image = sized_image(width, height, bytes.size());
  const std::size_t channels = grey ? 1 : 3;
  const char* from = reader.data(image.pixels.size() * channels * sizeof(float)).data();
  const auto next = [&] {
    std::uint32_t bits = 0;
    std::memcpy(&bits, from, sizeof bits);
    from += sizeof bits;
    return std::bit_cast<float>(scale < 0 ? bits : __builtin_bswap32(bits)) * std::abs(scale);
  };
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      Rgb& pixel = image.at(x, y);
      pixel = Rgb(next());
      if (!grey) pixel.g = next(), pixel.b = next();
    }
  }
  return image;
}

}  // namespace dspm
