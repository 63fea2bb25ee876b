// jpeglib.h needs size_t and FILE, jerror.h needs jpeglib.h.
// clang-format off
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <csetjmp>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/image.h"

namespace dspm {

namespace {

/// libjpeg reports errors by a longjmp, which runs no destructors: all that is allocated is held here, outside the
/// jump.
struct JpegReader {
  JpegReader() {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
    errors.error_exit = &on_error;
    errors.emit_message = &on_message;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  [[noreturn]] static void on_error(j_common_ptr jpeg) {
    auto& reader = *static_cast<JpegReader*>(jpeg->client_data);
    jpeg->err->format_message(jpeg, reader.message);
    std::longjmp(reader.jump, 1);
  }
  /// Fails at the warning about a file that ends too early, because libjpeg would fill the rest with grey. Other
  /// warnings are harmless.
  static void on_message(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) on_error(jpeg);
  }

  /// Bounds the number of scans: each covers the whole image, and may take only a few bytes of the file. libjpeg itself
  /// writes ten scans.
  static void on_progress(j_common_ptr jpeg) {
    constexpr int kMostScans = 100;
    auto& reader = *static_cast<JpegReader*>(jpeg->client_data);
    if (reader.jpeg.input_scan_number <= kMostScans) return;
    std::snprintf(reader.message, sizeof reader.message, "it has more than %d scans", kMostScans);
    std::longjmp(reader.jump, 1);
  }

  bool start(std::string_view bytes) {
    if (setjmp(jump) != 0) return false;
    jpeg_create_decompress(&jpeg);
    progress.progress_monitor = &on_progress;
    jpeg.progress = &progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg, TRUE);
    is_inked = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
    jpeg.out_color_space = is_inked ? JCS_CMYK : JCS_RGB;
    jpeg_calc_output_dimensions(&jpeg);
    return true;
  }
  bool read(Image& image, const std::vector<float>& linear) {
    if (setjmp(jump) != 0) return false;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
      Rgb* pixel = &image.at(0, static_cast<int>(jpeg.output_scanline));
      JSAMPROW to = row.data();
      jpeg_read_scanlines(&jpeg, &to, 1);
      if (is_inked) {
        take_inks(pixel, linear);
        continue;
      }
      for (std::size_t i = 0; i < row.size(); i += 3) {
        *pixel++ = {linear[row[i]], linear[row[i + 1]], linear[row[i + 2]]};
      }
    }
    jpeg_finish_decompress(&jpeg);
    return true;
  }

  /// Converts inks. Without a profile, they absorb red, green and blue, each its own, and black all. Adobe's programs
  /// write how much light they let pass.
  void take_inks(Rgb* pixel, const std::vector<float>& linear) const {
    const auto passes = [&](JSAMPLE ink) { return jpeg.saw_Adobe_marker ? int{ink} : 255 - ink; };
    for (std::size_t i = 0; i < row.size(); i += 4) {
      const auto light = [&](std::size_t ink) {
        return linear[static_cast<std::size_t>((passes(row[i + ink]) * passes(row[i + 3]) + 127) / 255)];
      };
      *pixel++ = {light(0), light(1), light(2)};
    }
  }

  bool is_inked = false;  // CMYK
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf jump{};
  std::vector<JSAMPLE> row;
  char message[JMSG_LENGTH_MAX] = "";
};

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

Image decode_jpeg(std::string_view bytes, ColorEncoding encoding) {
  JpegReader reader;
  if (!reader.start(bytes)) throw std::runtime_error(reader.message);
  Image image = sized_image(reader.jpeg.output_width, reader.jpeg.output_height, bytes.size());
  reader.row.resize(static_cast<std::size_t>(image.width) * (reader.is_inked ? 4 : 3));
  if (!reader.read(image, decoding_table(encoding, 256))) throw std::runtime_error(reader.message);
  return image;
}

}  // namespace dspm
