// WebP files, made by libwebp's encoder.
#include "dspm/image/webp.h"

#include <gtest/gtest.h>
#include <webp/encode.h>

#include <cmath>
#include <vector>

#include "dspm/base/system/atomic_file.h"
#include "dspm/image/encoding.h"
#include "tests/image/image_bytes.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace webp_test {

std::string file_of(std::uint8_t* data, std::size_t size) {
  std::string file(reinterpret_cast<const char*>(data), size);
  WebPFree(data);
  return file;
}

TEST(Webp, StillPicturesAreWrittenWithoutLoss) {
  const test::TemporaryDirectory directory;
  Image image(16, 8);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {srgb_to_linear(static_cast<float>(i) / 255), 0.5f, 0};
  for (const bool transparent : {false, true}) {
    if (transparent) image.alpha.assign(image.pixels.size(), 0.2f);
    write_webp(directory / "x.webp", image);
    const Image back = read_image(directory / "x.webp");
    EXPECT_EQ(srgb_bytes(back), srgb_bytes(image)) << transparent;
  }
  EXPECT_THROW(write_webp(directory / "wide.webp", Image(16384, 1)), WriteError);
}

TEST(Webp, WithoutLossAndWithAlpha) {
  const std::vector<std::uint8_t> pixels = {255, 0, 0, 255, 0, 51, 0, 51, 0, 0, 255, 102, 10, 20, 30, 255};
  std::uint8_t* data = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(pixels.data(), 2, 2, 8, &data);
  const std::string file = file_of(data, size);
  const Image image = decode_image(file, test::kLinear);
  ASSERT_EQ(image.pixels.size(), 4u);
  ASSERT_EQ(image.alpha.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(image.pixels[i][c] * 255, static_cast<float>(pixels[4 * i + static_cast<std::size_t>(c)])) << i;
    EXPECT_FLOAT_EQ(image.alpha[i] * 255, static_cast<float>(pixels[4 * i + 3])) << i;
  }
  EXPECT_FLOAT_EQ(decode_image(file, {}).at(1, 0).g, srgb_to_linear(0.2f));
}

TEST(Webp, WithLoss) {
  std::vector<std::uint8_t> pixels(16 * 16 * 3, 128);
  std::uint8_t* data = nullptr;
  const std::size_t size = WebPEncodeRGB(pixels.data(), 16, 16, 48, 90, &data);
  const std::string file = file_of(data, size);
  const Image image = decode_image(file, test::kLinear);
  EXPECT_TRUE(image.alpha.empty());
  for (const Rgb& pixel : image.pixels) EXPECT_NEAR(pixel.g, 128. / 255, 2.5 / 255);
  EXPECT_NE(test::message_for(file.substr(0, 20)), "");
  for (std::size_t length = 0; length < file.size(); ++length) test::message_for(file.substr(0, length));
}

}  // namespace webp_test
}  // namespace dspm
