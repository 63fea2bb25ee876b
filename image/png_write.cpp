#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/image/encoding.h"
#include "dspm/image/icc_profile.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"

namespace dspm {
namespace {

/// Primaries of P3 with white D65, the curve of sRGB, RGB, full range. [H.273]
constexpr png_byte kCodePoints[] = {12, 13, 0, 1};

/// libpng reports errors by a longjmp, which runs no destructors: all that is allocated is held here, outside the jump.
struct PngWriter {
  PngWriter(const Image& image, const PngFormat& wanted)
      : format(wanted),
        width(static_cast<png_uint_32>(image.width)),
        height(static_cast<png_uint_32>(image.height)),
        channels(channels_of(image)),
        samples(encoded(image, 1 << wanted.bits, wanted.space != PngSpace::linear)) {
    if (format.space == PngSpace::display_p3) profile = icc_profile(ColourSpace::dci_p3, "Display P3");
    set_rows();
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    png_set_write_fn(png, this, &on_write, nullptr);
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  static PngWriter& of(png_const_structp png) { return *static_cast<PngWriter*>(png_get_error_ptr(png)); }
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    std::strncpy(of(png).message, message, sizeof of(png).message - 1);
    std::longjmp(png_jmpbuf(png), 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_write(png_structp png, png_bytep from, std::size_t count) {
    of(png).bytes.append(reinterpret_cast<const char*>(from), count);
  }

  void set_rows() {
    if (format.bits == 8) narrow.assign(samples.begin(), samples.end());
    for (std::size_t y = 0; y < height; ++y) {
      const std::size_t first = y * width * channels;
      rows.push_back(format.bits == 8 ? narrow.data() + first : reinterpret_cast<png_bytep>(samples.data() + first));
    }
  }
  void say_space() {
    if (format.space == PngSpace::srgb) return png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    const bool p3 = format.space == PngSpace::display_p3;
    const Chromaticities& c = chromaticities(p3 ? ColourSpace::dci_p3 : ColourSpace::srgb);
    png_set_gAMA(png, info, p3 ? 1 / 2.2 : 1);
    png_set_cHRM(png, info, c.white.x, c.white.y, c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y);
    if (!p3) return;
    png_set_iCCP(png, info, "Display P3", PNG_COMPRESSION_TYPE_BASE, reinterpret_cast<png_const_bytep>(profile.data()),
                 static_cast<png_uint_32>(profile.size()));
    png_unknown_chunk chunk = {{'c', 'I', 'C', 'P', 0}, const_cast<png_bytep>(kCodePoints), 4, PNG_HAVE_IHDR};
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, chunk.name, 1);
    png_set_unknown_chunks(png, info, &chunk, 1);
  }
  bool write() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_IHDR(png, info, width, height, format.bits, channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    say_space();
    png_write_info(png, info);
    if (std::endian::native == std::endian::little) png_set_swap(png);
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    return true;
  }

  PngFormat format;
  png_uint_32 width, height;
  std::size_t channels;
  std::vector<std::uint16_t> samples;
  std::vector<png_byte> narrow;  // the samples of eight bits
  std::vector<png_bytep> rows;
  std::string profile, bytes;
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[128] = "no PNG could be made";
};

}  // namespace

std::string png_bytes(const Image& image, const PngFormat& format) {
  PngWriter writer(image, format);
  if (!writer.write()) throw std::runtime_error(writer.message);
  return std::move(writer.bytes);
}

void write_png(const std::filesystem::path& path, const Image& image, const PngFormat& format) {
  try {
    write_file(path, png_bytes(image, format));
  } catch (const WriteError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw WriteError(path, error.what());
  }
}

}  // namespace dspm
