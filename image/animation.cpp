#include "dspm/image/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/extension.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

constexpr float kQuality = 90;  // of 100

struct Picture : WebPPicture {
  explicit Picture(const Image& image) {
    if (WebPPictureInit(this) == 0) throw std::runtime_error("the WebP library is another one than its headers");
    width = image.width, height = image.height, use_argb = 1;
    const std::string bytes = srgb_bytes(image);
    if (WebPPictureImportRGB(this, reinterpret_cast<const std::uint8_t*>(bytes.data()), 3 * image.width) == 0)
      throw std::bad_alloc();
  }
  ~Picture() { WebPPictureFree(this); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
};

using Encoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

void expect(int ok, const Encoder& encoder) {
  if (ok == 0) throw std::runtime_error(std::string("WebP: ") + WebPAnimEncoderGetError(encoder.get()));
}

}  // namespace

std::string webp_bytes(const std::vector<Image>& images, double seconds) {
  WebPAnimEncoderOptions options;
  WebPConfig config;
  if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&config) == 0 || images.empty())
    throw std::runtime_error("WebP: no encoder");
  config.quality = kQuality;
  const Encoder encoder(WebPAnimEncoderNew(images.front().width, images.front().height, &options),
                        &WebPAnimEncoderDelete);
  if (encoder == nullptr) throw std::runtime_error("WebP: the image is too large");
  const auto time = [&](std::size_t i) {
    return static_cast<int>(std::lround(static_cast<double>(i) * seconds * 1000));
  };
  for (std::size_t i = 0; i < images.size(); ++i) {
    Picture picture(images[i]);
    expect(WebPAnimEncoderAdd(encoder.get(), &picture, time(i), &config), encoder);
  }
  expect(WebPAnimEncoderAdd(encoder.get(), nullptr, time(images.size()), nullptr), encoder);
  WebPData data;
  WebPDataInit(&data);
  const int ok = WebPAnimEncoderAssemble(encoder.get(), &data);
  const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  expect(ok, encoder);
  return bytes;
}

bool is_animation_name(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".webp" || extension == ".apng";
}

void write_animation(const std::filesystem::path& path, const std::vector<Image>& images, double seconds,
                     const PngFormat& format) {
  std::string bytes;
  try {
    bytes = extension_of(path) == ".webp" ? webp_bytes(images, seconds) : apng_bytes(images, seconds, format);
  } catch (const std::runtime_error& error) {
    throw WriteError(path, error.what());
  }
  write_file(path, bytes);
}

}  // namespace dspm
