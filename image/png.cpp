#include "dspm/image/png.h"

#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/samples.h"

namespace dspm {

namespace {

/// libpng reports errors by a longjmp, which runs no destructors: all that is allocated is held here, outside the jump.
struct PngReader {
  explicit PngReader(std::string_view file) : bytes(file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
    if (png != nullptr) info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    png_set_read_fn(png, this, &on_read);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  static PngReader& of(png_const_structp png) { return *static_cast<PngReader*>(png_get_error_ptr(png)); }
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    std::strncpy(of(png).message, message, sizeof of(png).message - 1);
    std::longjmp(png_jmpbuf(png), 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    std::string_view& rest = of(png).bytes;
    if (count > rest.size()) png_error(png, "the file ends too early");
    std::memcpy(to, rest.data(), count);
    rest.remove_prefix(count);
  }

  /// Reads the size, and makes everything 16-bit RGB, with alpha if the file has it; 8-bit values v become 257 v.
  bool read_size() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_swap(png);  // to the least significant byte first
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
  }
  bool read_rows() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
  }

  std::string_view bytes;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint16_t> samples;
  std::vector<png_bytep> rows;
  char message[128] = "not a PNG file";
};

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

Image decode_png(std::string_view bytes, ColorEncoding encoding) {
  PngReader reader(bytes);
  if (!reader.read_size()) throw std::runtime_error(reader.message);
  Image image = sized_image(png_get_image_width(reader.png, reader.info), png_get_image_height(reader.png, reader.info),
                            bytes.size());

  const std::size_t channels = png_get_channels(reader.png, reader.info);
  const std::size_t row = channels * static_cast<std::size_t>(image.width);
  reader.samples.resize(row * static_cast<std::size_t>(image.height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    reader.rows.push_back(reinterpret_cast<png_bytep>(reader.samples.data() + y * row));
  }
  if (!reader.read_rows()) throw std::runtime_error(reader.message);
  set_pixels<std::uint16_t>(image, reader.samples, channels, decoding_table(encoding, 1 << 16));
  return image;
}

}  // namespace dspm
