#include "dspm/image/animation.h"

#include <gtest/gtest.h>
#include <webp/demux.h>
#include <zlib.h>

#include <cstdint>

#include "dspm/image/encoding.h"
#include "tests/image/image_bytes.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace animation_test {

const Rgb kColours[] = {{1, 0, 0}, {0, 1, 0}, {0.2f, 0.2f, 0.9f}};

std::vector<Image> three_images() {
  std::vector<Image> images;
  for (const Rgb& colour : kColours) {
    images.emplace_back(20, 10);
    for (Rgb& pixel : images.back().pixels) pixel = colour;
  }
  return images;
}

struct Chunk {
  std::string name, content;
};

std::vector<Chunk> chunks_of(const std::string& png) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < png.size();) {
    const std::uint32_t size = number_at(png, at);
    const std::string both = png.substr(at + 4, 4 + size);
    EXPECT_EQ(number_at(png, at + 8 + size), crc32(0, reinterpret_cast<const Bytef*>(both.data()), 4 + size));
    chunks.push_back({both.substr(0, 4), both.substr(4)});
    at += 12 + size;
  }
  return chunks;
}

TEST(Animation, OtherReadersSeeTheFirstImageOfAnApng) {
  const Image first = decode_png(apng_bytes(three_images(), 0.25), {});
  EXPECT_EQ(first.width, 20);
  for (const Rgb& pixel : first.pixels) EXPECT_EQ(pixel, kColours[0]);
}

/// Its frames made PNGs again: their data is in fdAT, after a number.
TEST(Animation, AnApngHoldsAllImagesInOrder) {
  const std::string file = apng_bytes(three_images(), 0.25);
  std::vector<std::string> data;
  std::uint32_t sequence = 0;
  std::string header;
  for (const auto& [name, content] : chunks_of(file)) {
    if (name == "IHDR") header = content;
    if (name == "acTL") {
      EXPECT_EQ(number_at(content, 0), 3u);
      EXPECT_EQ(number_at(content, 4), 0u) << "for ever";
    }
    if (name == "fcTL") {
      EXPECT_EQ(number_at(content, 0), sequence++);
      EXPECT_EQ(number_at(content, 4), 20u);
      EXPECT_EQ(number_at(content, 20), 250u << 16 | 1000u) << "a quarter of a second";
      data.emplace_back();
    }
    if (name == "fdAT") {
      EXPECT_EQ(number_at(content, 0), sequence++);
    }
    if (name == "fdAT" || name == "IDAT") data.back() += content.substr(name == "fdAT" ? 4 : 0);
  }
  ASSERT_EQ(data.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    std::string rows(10 * (1 + 3 * 20), '\0');
    uLongf size = rows.size();
    ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, reinterpret_cast<const Bytef*>(data[i].data()),
                         data[i].size()),
              Z_OK);
    ASSERT_EQ(size, rows.size());
    Image pixel(1, 1);
    pixel.at(0, 0) = kColours[i];
    EXPECT_EQ(rows.substr(1, 3), srgb_bytes(pixel));
  }
}

TEST(Animation, AWebpHoldsAllImagesInOrder) {
  const std::string file = webp_bytes(three_images(), 0.25);
  const WebPData data = {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
  WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  EXPECT_EQ(info.frame_count, 3u);
  EXPECT_EQ(info.loop_count, 0u);
  for (int i = 0; i < 3; ++i) {
    std::uint8_t* pixels = nullptr;
    int end = 0;
    ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &pixels, &end));
    EXPECT_EQ(end, 250 * (i + 1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixels[c], 255 * linear_to_srgb(kColours[i][c]), 8) << i;
  }
  WebPAnimDecoderDelete(decoder);
}

TEST(Animation, TheExtensionChooses) {
  const test::TemporaryDirectory directory;
  write_animation(directory / "a.apng", three_images(), 1);
  write_animation(directory / "a.webp", three_images(), 1);
  EXPECT_EQ(read_image(directory / "a.apng").width, 20);
  EXPECT_THROW(read_image(directory / "a.webp"), std::runtime_error) << "an animation is no picture";
  EXPECT_TRUE(is_animation_name("a.webp") && is_animation_name("b.apng"));
  EXPECT_FALSE(is_animation_name("a.png"));
}

}  // namespace animation_test
}  // namespace dspm::test
