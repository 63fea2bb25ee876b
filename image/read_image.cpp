#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/read_file.h"
#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"
#include "dspm/image/exr.h"
#include "dspm/image/exr_window.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/image/read_picture.h"

namespace dspm {

Image decode_image(std::string_view bytes, ColorEncoding encoding) {
  if (is_png(bytes)) return decode_png(bytes, encoding);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, encoding);
  if (is_tiff(bytes)) return decode_tiff(bytes, encoding);
  if (is_webp(bytes)) return decode_webp(bytes, encoding);
  if (is_qoi(bytes)) return decode_qoi(bytes, encoding);
  if (is_bmp(bytes)) return decode_bmp(bytes, encoding);
  if (is_pnm(bytes)) return decode_pnm(bytes, encoding);
  const bool exr = is_exr(bytes), hdr = is_hdr(bytes);
  if (!exr && !hdr && !is_pfm(bytes)) {
    if (is_tga(bytes)) return decode_tga(bytes, encoding);  // last, as it has no signature
    throw std::runtime_error(
        "it is not a PNG, JPEG, OpenEXR, Radiance HDR, TIFF, WebP, QOI, BMP, PNM, PFM or TGA file");
  }
  Image image = exr ? decode_exr(bytes) : hdr ? decode_hdr(bytes) : decode_pfm(bytes);
  for (Rgb& pixel : image.pixels)
    pixel = {decode(encoding, pixel.r), decode(encoding, pixel.g), decode(encoding, pixel.b)};
  return image;
}

Image sized_image(std::int64_t width, std::int64_t height, std::size_t file_bytes) {
#ifdef DSPM_FUZZ  // fuzzing tries millions of inputs, and large images take long
  constexpr std::size_t kPixelsPerByte = 8, kOnTrust = std::size_t{1} << 12;
#else
  // Real pictures have far fewer than 256 pixels per byte, but an image of one colour may reach thousands. Up to 16
  // million are taken on trust, so that a file below 200 kB never takes more than a gigabyte.
  constexpr std::size_t kPixelsPerByte = 256, kOnTrust = std::size_t{1} << 24;
#endif
  const std::size_t most = std::min(kMaxPixels, std::max(kOnTrust, kPixelsPerByte * file_bytes));
  if (width < 1 || height < 1) throw std::runtime_error("its size is invalid");
  if (static_cast<std::size_t>(width) > most / static_cast<std::size_t>(height)) {
    throw std::runtime_error(
        fmt::format("{} x {} pixels are too many for {} bytes: at most {} million are read; make the "
                    "image smaller",
                    width, height, file_bytes, most / 1'000'000));
  }
  return Image(static_cast<int>(width), static_cast<int>(height));
}

namespace {

template <class Decode>
Image read(const std::filesystem::path& path, Decode&& decode) {
  try {
    return decode(read_bytes(path));
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("cannot read the image " + path.string() + ": it does not fit into memory");
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read the image " + path.string() + ": " + error.what());
  }
}

}  // namespace

Image read_image(const std::filesystem::path& path, ColorEncoding encoding) {
  return read(path, [&](const std::string& bytes) { return decode_image(bytes, encoding); });
}

Image read_picture(const std::filesystem::path& path, ColorEncoding encoding) {
  return read(path, [&](const std::string& bytes) {
    Image image = decode_image(bytes, encoding);
    return is_exr(bytes) ? in_display_window(std::move(image), bytes) : image;
  });
}

}  // namespace dspm
