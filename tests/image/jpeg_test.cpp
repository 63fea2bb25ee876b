// clang-format off
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>
// clang-format on

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/image/decoders.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace jpeg_test {

struct JpegKind {
  int width, height, channels;
  J_COLOR_SPACE space;
  bool progressive = false;
};

std::string jpeg_of(const JpegKind& kind, std::vector<JSAMPLE> samples) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(kind.width), jpeg.image_height = static_cast<JDIMENSION>(kind.height);
  jpeg.input_components = kind.channels, jpeg.in_color_space = kind.space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (kind.progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    JSAMPROW row = samples.data() + jpeg.next_scanline * static_cast<unsigned>(kind.width * kind.channels);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::string result(reinterpret_cast<char*>(bytes), size);
  std::free(bytes);
  return result;
}

/// Left half of the first colour, right half of the second, so that chroma subsampling does no harm.
std::vector<JSAMPLE> halves(const JpegKind& kind, const std::vector<JSAMPLE>& left, const std::vector<JSAMPLE>& right) {
  std::vector<JSAMPLE> samples;
  for (int i = 0; i < kind.width * kind.height; ++i) {
    const auto& color = i % kind.width < kind.width / 2 ? left : right;
    samples.insert(samples.end(), color.begin(), color.end());
  }
  return samples;
}

void expect_near(const Rgb& color, int r, int g, int b) {
  EXPECT_NEAR(linear_to_srgb(color.r) * 255, r, 3);
  EXPECT_NEAR(linear_to_srgb(color.g) * 255, g, 3);
  EXPECT_NEAR(linear_to_srgb(color.b) * 255, b, 3);
}

TEST(Jpeg, ColourBaselineAndProgressive) {
  for (const bool progressive : {false, true}) {
    const JpegKind kind{64, 32, 3, JCS_RGB, progressive};
    const Image image = decode_jpeg(jpeg_of(kind, halves(kind, {200, 30, 60}, {10, 120, 250})), {});
    ASSERT_EQ(image.width, 64);
    ASSERT_EQ(image.height, 32);
    expect_near(image.at(5, 5), 200, 30, 60);
    expect_near(image.at(60, 30), 10, 120, 250);
  }
}

TEST(Jpeg, Grey) {
  const JpegKind kind{64, 32, 1, JCS_GRAYSCALE};
  const Image image = decode_jpeg(jpeg_of(kind, halves(kind, {40}, {220})), {});
  expect_near(image.at(5, 5), 40, 40, 40);
  expect_near(image.at(60, 30), 220, 220, 220);
}

// The library marks CMYK as Adobe's, whose numbers say how much light the inks let pass.
TEST(Jpeg, InksLetLightPass) {
  const JpegKind kind{64, 32, 4, JCS_CMYK};
  const Image image = decode_jpeg(jpeg_of(kind, halves(kind, {255, 128, 0, 255}, {200, 100, 50, 128})), {});
  expect_near(image.at(5, 5), 255, 128, 0);
  expect_near(image.at(60, 30), 100, 50, 25);
}

TEST(Jpeg, AFileThatEndsTooEarlyIsAnError) {
  const JpegKind kind{64, 64, 3, JCS_RGB};
  std::vector<JSAMPLE> samples;
  for (int i = 0; i < 64 * 64 * 3; ++i) samples.push_back(static_cast<JSAMPLE>(i * i % 251));
  const std::string bytes = jpeg_of(kind, samples);
  EXPECT_NO_THROW(decode_jpeg(bytes, {}));
  EXPECT_THROW(decode_jpeg(bytes.substr(0, bytes.size() / 2), {}), std::runtime_error);
}

TEST(Jpeg, AlteredFilesYieldAnImageOrAnError) {
  std::mt19937 random(1);
  for (const bool progressive : {false, true}) {
    const JpegKind kind{40, 40, 3, JCS_RGB, progressive};
    const std::string bytes = jpeg_of(kind, halves(kind, {200, 30, 60}, {10, 120, 250}));
    for (int round = 0; round < 1000; ++round) {
      std::string altered = bytes.substr(0, bytes.size() - random() % 20);
      for (unsigned n = random() % 4; n > 0; --n) altered[random() % altered.size()] = static_cast<char>(random());
      try {
        const Image image = decode_jpeg(altered, {});
        EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
      } catch (const std::runtime_error&) {}
    }
  }
}

}  // namespace jpeg_test
}  // namespace dspm
