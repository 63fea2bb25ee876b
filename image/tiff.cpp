// TIFF through libtiff, from memory.
#include <tiffio.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/image/samples.h"

namespace dspm {

namespace {

struct TiffSource {
  std::string_view bytes;
  std::uint64_t at = 0;
  std::string error;

  static TiffSource& of(thandle_t handle) { return *static_cast<TiffSource*>(handle); }
  static tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
    TiffSource& source = of(handle);
    if (count <= 0 || source.at >= source.bytes.size()) return 0;
    const std::size_t taken = std::min(static_cast<std::size_t>(count), source.bytes.size() - source.at);
    std::memcpy(to, source.bytes.data() + source.at, taken);
    source.at += taken;
    return static_cast<tmsize_t>(taken);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return -1; }
  static toff_t seek(thandle_t handle, toff_t to, int from) {
    TiffSource& source = of(handle);
    return source.at = to + (from == SEEK_CUR ? source.at : from == SEEK_END ? source.bytes.size() : 0);
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
  static int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
    char text[200];
    std::vsnprintf(text, sizeof text, format, arguments);
    std::string& first = static_cast<TiffSource*>(user)->error;
    if (first.empty()) first = text;
    return 1;
  }
  static int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }
};

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

Tiff open_tiff(TiffSource& source) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             &TIFFOpenOptionsFree);
  if (!options) throw std::bad_alloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &TiffSource::on_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &TiffSource::on_warning, &source);
  // A strip or tile of the largest image that a small file may announce: 16 million pixels of 4 channels of 4 bytes.
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t{1} << 28);
  return {TIFFClientOpenExt("", "rm", &source, &TiffSource::read, &TiffSource::write, &TiffSource::seek,
                            &TiffSource::close, &TiffSource::size, nullptr, nullptr, options.get()),
          &TIFFClose};
}

template <class T>
T field(const Tiff& tiff, std::uint32_t tag, T otherwise) {
  T value = otherwise;
  return TIFFGetFieldDefaulted(tiff.get(), tag, &value) == 1 ? value : otherwise;
}

struct Layout {
  std::uint16_t bits, channels, format, photometric, planes;
  /// Returns whether read_rows reads it; the library converts the others.
  bool plain() const {
    const bool number =
        format == SAMPLEFORMAT_UINT ? bits == 8 || bits == 16 : format == SAMPLEFORMAT_IEEEFP && bits == 32;
    const bool colour = photometric == PHOTOMETRIC_RGB ? channels == 3 || channels == 4
                                                       : photometric == PHOTOMETRIC_MINISBLACK && channels <= 2;
    return number && colour && planes == PLANARCONFIG_CONTIG;
  }
  std::size_t pixel_bytes() const { return std::size_t{channels} * bits / 8; }
};

[[noreturn]] void fail(const TiffSource& source) {
  throw std::runtime_error(source.error.empty() ? "its pixels cannot be read" : source.error);
}

/// Returns all samples in the order of the pixels.
std::vector<unsigned char> read_rows(const Tiff& tiff, const TiffSource& source, const Image& image,
                                     std::size_t pixel) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  std::vector<unsigned char> samples(width * height * pixel);
  if (TIFFIsTiled(tiff.get()) == 0) {
    if (static_cast<std::size_t>(TIFFScanlineSize(tiff.get())) != width * pixel) fail(source);
    for (std::size_t y = 0; y < height; ++y) {
      if (TIFFReadScanline(tiff.get(), &samples[y * width * pixel], static_cast<std::uint32_t>(y), 0) < 0) fail(source);
    }
    return samples;
  }
  const std::size_t tile_width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
  const std::size_t tile_height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
  const tmsize_t size = TIFFTileSize(tiff.get());
  if (tile_width == 0 || tile_height == 0 || size <= 0 || size > tmsize_t{1} << 28 ||
      static_cast<std::size_t>(size) != tile_width * tile_height * pixel) {
    throw std::runtime_error("the size of its tiles is invalid");
  }
  std::vector<unsigned char> tile(static_cast<std::size_t>(size));
  for (std::size_t y = 0; y < height; y += tile_height) {
    for (std::size_t x = 0; x < width; x += tile_width) {
      if (TIFFReadTile(tiff.get(), tile.data(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0) < 0)
        fail(source);
      const std::size_t columns = std::min(tile_width, width - x), rows = std::min(tile_height, height - y);
      for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(&samples[((y + row) * width + x) * pixel], &tile[row * tile_width * pixel], columns * pixel);
      }
    }
  }
  return samples;
}

/// Returns what the last channel means: alpha, with which colours are multiplied or not, or something else.
std::uint16_t extra_channel(const Tiff& tiff) {
  std::uint16_t count = 0;
  const std::uint16_t* kinds = nullptr;
  const bool any = TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds) == 1 && count > 0;
  return any ? kinds[0] : std::uint16_t{EXTRASAMPLE_UNSPECIFIED};
}

/// Divides colours by the alpha that they were multiplied with.
template <class T>
void divide_by_alpha(std::vector<T>& samples, std::size_t channels) {
  for (std::size_t i = 0; i + channels <= samples.size(); i += channels) {
    const T alpha = samples[i + channels - 1];
    if (!(alpha > 0)) continue;
    for (std::size_t c = 0; c + 1 < channels; ++c) {
      T& sample = samples[i + c];
      if constexpr (std::is_floating_point_v<T>) {
        sample = sample / alpha;
      } else {
        constexpr std::uint32_t kMost = std::numeric_limits<T>::max();
        sample = static_cast<T>(std::min(kMost, (sample * kMost + alpha / 2) / alpha));
      }
    }
  }
}

template <class T>
std::vector<T> as(const std::vector<unsigned char>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

template <class T>
void set_from_integers(Image& image, std::vector<T> samples, std::size_t channels, bool multiplied,
                       ColorEncoding encoding) {
  if (multiplied) divide_by_alpha(samples, channels);
  set_pixels<T>(image, samples, channels, decoding_table(encoding, int{std::numeric_limits<T>::max()} + 1));
}

void set_from_floats(Image& image, std::vector<float> values, std::size_t channels, bool multiplied,
                     ColorEncoding encoding) {
  if (multiplied) divide_by_alpha(values, channels);
  const std::size_t green = channels < 3 ? 0 : 1, blue = channels < 3 ? 0 : 2;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float* value = &values[i * channels];
    image.pixels[i] = {decode(encoding, value[0]), decode(encoding, value[green]), decode(encoding, value[blue])};
    if (channels % 2 == 0) image.alpha.push_back(value[channels - 1]);
  }
}

/// Reads eight bits of red, green, blue and alpha, whatever the file holds.
void convert(const Tiff& tiff, const TiffSource& source, Image& image, ColorEncoding encoding) {
  std::vector<std::uint32_t> packed(image.pixels.size());
  if (TIFFReadRGBAImageOriented(tiff.get(), static_cast<std::uint32_t>(image.width),
                                static_cast<std::uint32_t>(image.height), packed.data(), ORIENTATION_TOPLEFT, 1) == 0)
    fail(source);
  std::vector<unsigned char> samples;
  samples.reserve(4 * packed.size());
  for (const std::uint32_t p : packed) {
    for (const std::uint32_t c : {TIFFGetR(p), TIFFGetG(p), TIFFGetB(p), TIFFGetA(p)})
      samples.push_back(static_cast<unsigned char>(c));
  }
  set_from_integers(image, std::move(samples), 4, true, encoding);  // the library multiplies by alpha
}

}  // namespace

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
         bytes.starts_with("MM\0+"sv);
}

Image decode_tiff(std::string_view bytes, ColorEncoding encoding) {
  TiffSource source{bytes, 0, {}};
  const Tiff tiff = open_tiff(source);
  if (!tiff) fail(source);
  Image image = sized_image(field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0),
                            field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0), bytes.size());
  const auto number = [&](std::uint32_t tag) { return field<std::uint16_t>(tiff, tag, 0); };
  const Layout layout{number(TIFFTAG_BITSPERSAMPLE), number(TIFFTAG_SAMPLESPERPIXEL), number(TIFFTAG_SAMPLEFORMAT),
                      number(TIFFTAG_PHOTOMETRIC), number(TIFFTAG_PLANARCONFIG)};
  if (!layout.plain() || field<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, 1) != ORIENTATION_TOPLEFT) {
    convert(tiff, source, image, encoding);
    return image;
  }
  const std::vector<unsigned char> samples = read_rows(tiff, source, image, layout.pixel_bytes());
  const std::size_t channels = layout.channels;
  const std::uint16_t extra = extra_channel(tiff);
  const bool multiplied = channels % 2 == 0 && extra == EXTRASAMPLE_ASSOCALPHA;
  if (layout.bits == 32) {
    set_from_floats(image, as<float>(samples), channels, multiplied, encoding);
  } else if (layout.bits == 16) {
    set_from_integers(image, as<std::uint16_t>(samples), channels, multiplied, encoding);
  } else {
    set_from_integers(image, samples, channels, multiplied, encoding);
  }
  if (extra == EXTRASAMPLE_UNSPECIFIED) image.alpha.clear();
  return image;
}

}  // namespace dspm
