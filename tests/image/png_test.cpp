// PNG in all its colour types, written by libpng itself, against values known from the samples.
#include "dspm/image/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/image/encoding.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace png_test {

using test::TemporaryDirectory;
const ColorEncoding kLinear{ColorEncoding::Kind::linear, 1};

struct PngKind {
  int width, height, bits, color_type;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<png_color> palette = {};
};

/// `samples` are the rows as PNG has them: packed bits, 16-bit values with the high byte first.
void write_raw_png(const std::filesystem::path& path, const PngKind& kind, std::vector<png_byte> samples) {
  FILE* file = fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(kind.width), static_cast<png_uint_32>(kind.height), kind.bits,
               kind.color_type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!kind.palette.empty()) png_set_PLTE(png, info, kind.palette.data(), static_cast<int>(kind.palette.size()));
  png_write_info(png, info);
  std::vector<png_bytep> rows;
  const std::size_t row_bytes = samples.size() / static_cast<std::size_t>(kind.height);
  for (std::size_t y = 0; y < static_cast<std::size_t>(kind.height); ++y)
    rows.push_back(samples.data() + y * row_bytes);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  fclose(file);
}

/// The chunks of a PNG file before its pixels, by name.
std::map<std::string, std::string> chunks(const std::string& png) {
  std::map<std::string, std::string> found;
  for (std::size_t at = 8; at + 8 < png.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png[at + i]);
    const std::string name = png.substr(at + 4, 4);
    if (name == "IDAT") break;
    found[name] = png.substr(at + 8, size);
    at += 12 + size;
  }
  return found;
}

Image ramp() {
  Image image(200, 1);
  for (int x = 0; x < 200; ++x) image.at(x, 0) = Rgb(static_cast<float>(x) / 199, 0.5f, 0.01f);
  return image;
}

TEST(Png, SixteenBitsAreExactToHalfAStep) {
  const std::string png = png_bytes(ramp(), {.bits = 16});
  EXPECT_EQ(chunks(png).at("IHDR")[8], 16);
  const Image back = decode_png(png, {});
  for (int x = 0; x < 200; ++x)
    EXPECT_NEAR(linear_to_srgb(back.at(x, 0).r), linear_to_srgb(ramp().at(x, 0).r), 0.51 / 65535) << x;
  EXPECT_NE(back.at(0, 0).g, decode_png(png_bytes(ramp()), {}).at(0, 0).g);
}

TEST(Png, ChunksSayWhatTheNumbersMean) {
  const auto srgb = chunks(png_bytes(ramp())), linear = chunks(png_bytes(ramp(), {.space = PngSpace::linear})),
             p3 = chunks(png_bytes(ramp(), {.space = PngSpace::display_p3}));
  EXPECT_TRUE(srgb.contains("sRGB") && srgb.contains("gAMA") && srgb.contains("cHRM"));
  EXPECT_FALSE(srgb.contains("iCCP"));
  EXPECT_EQ(linear.at("gAMA"), std::string("\x00\x01\x86\xa0", 4));  // 100000: 1
  EXPECT_FALSE(linear.contains("sRGB"));
  EXPECT_EQ(p3.at("cICP"), std::string("\x0c\x0d\x00\x01", 4));
  EXPECT_EQ(p3.at("iCCP").substr(0, 11), std::string("Display P3\0", 11));
  EXPECT_FALSE(p3.contains("sRGB"));
  EXPECT_EQ(p3.at("cHRM").substr(8, 4), std::string("\x00\x01\x09\xa0", 4));  // the red x: 68000
}

TEST(Png, LinearNumbersStayAsTheyAre) {
  const Image back = decode_png(png_bytes(ramp(), {.bits = 16, .space = PngSpace::linear}), kLinear);
  for (int x = 0; x < 200; ++x) EXPECT_NEAR(back.at(x, 0).r, ramp().at(x, 0).r, 1e-5) << x;
}

TEST(Png, RoundTripIsExactToHalfAStep) {
  const TemporaryDirectory directory;
  Image image(256, 3);
  for (int x = 0; x < 256; ++x) {
    const float v = srgb_to_linear(static_cast<float>(x) / 255);
    image.at(x, 0) = Rgb(v), image.at(x, 1) = Rgb(v, 0, 1 - v), image.at(x, 2) = Rgb(0, v, v);
  }
  write_png(directory / "a.png", image);
  const Image back = read_image(directory / "a.png");
  ASSERT_EQ(back.width, 256);
  ASSERT_EQ(back.height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(linear_to_srgb(back.pixels[i][c]), linear_to_srgb(image.pixels[i][c]), 0.5001 / 255);
    }
  }
  write_png(directory / "b.png", back);
  EXPECT_EQ(test::contents(directory / "a.png"), test::contents(directory / "b.png"));
}

TEST(Png, TransparencyIsWrittenAndNeverEncoded) {
  Image image(3, 2);
  for (std::size_t i = 0; i < 6; ++i) {
    image.pixels[i] = Rgb(0.1f * static_cast<float>(i), 0.5f, 1);
    image.alpha.push_back(0.2f * static_cast<float>(i));
  }
  for (const int bits : {8, 16}) {
    const Image back = decode_png(png_bytes(image, {bits}), {});
    ASSERT_EQ(back.alpha.size(), 6u) << bits;
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(back.alpha[i], image.alpha[i], 1e-4) << bits;
      EXPECT_NEAR(back.pixels[i].r, image.pixels[i].r, 0.005) << bits;
    }
  }
  // Even if all is opaque: the images of a sequence are alike.
  image.alpha.assign(6, 1);
  EXPECT_EQ(png_bytes(image)[25], PNG_COLOR_TYPE_RGB_ALPHA);
}

TEST(Png, WhatCannotBeShownIsClamped) {
  const TemporaryDirectory directory;
  Image image(2, 1);
  image.at(0, 0) = {-1, 7, std::numeric_limits<float>::quiet_NaN()};
  image.at(1, 0) = {kInfinity, -kInfinity, 1};
  write_png(directory / "a.png", image);
  const Image back = read_image(directory / "a.png");
  EXPECT_EQ(back.at(0, 0), Rgb(0, 1, 0));
  EXPECT_EQ(back.at(1, 0), Rgb(1, 0, 1));
}

TEST(Png, SixteenBitsAreKept) {
  const TemporaryDirectory directory;
  write_raw_png(directory / "a.png", {2, 1, 16, PNG_COLOR_TYPE_RGB},
                {0, 1, 0x12, 0x34, 0xff, 0xff, 0, 0, 0x80, 0, 0, 2});
  const Image image = read_image(directory / "a.png", kLinear);
  EXPECT_EQ(image.at(0, 0), Rgb(1 / 65535.f, 0x1234 / 65535.f, 1));
  EXPECT_EQ(image.at(1, 0), Rgb(0, 0x8000 / 65535.f, 2 / 65535.f));
}

TEST(Png, GreyOfOneEightAndSixteenBits) {
  const TemporaryDirectory directory;
  write_raw_png(directory / "1.png", {3, 2, 1, PNG_COLOR_TYPE_GRAY}, {0b10100000, 0b01000000});
  const Image one = read_image(directory / "1.png", kLinear);
  for (int x = 0; x < 3; ++x) {
    EXPECT_EQ(one.at(x, 0), Rgb(x == 1 ? 0 : 1));
    EXPECT_EQ(one.at(x, 1), Rgb(x == 1 ? 1 : 0));
  }
  write_raw_png(directory / "8.png", {2, 1, 8, PNG_COLOR_TYPE_GRAY}, {51, 255});
  EXPECT_EQ(read_image(directory / "8.png", kLinear).at(0, 0), Rgb(51 / 255.f));
  write_raw_png(directory / "16.png", {1, 1, 16, PNG_COLOR_TYPE_GRAY}, {0x12, 0x34});
  EXPECT_EQ(read_image(directory / "16.png", kLinear).at(0, 0), Rgb(0x1234 / 65535.f));
}

TEST(Png, AlphaIsIgnoredNotMultiplied) {
  const TemporaryDirectory directory;
  write_raw_png(directory / "rgba.png", {2, 1, 8, PNG_COLOR_TYPE_RGB_ALPHA}, {255, 51, 0, 0, 0, 255, 51, 128});
  const Image rgba = read_image(directory / "rgba.png", kLinear);
  EXPECT_EQ(rgba.at(0, 0), Rgb(1, 51 / 255.f, 0));
  EXPECT_EQ(rgba.at(1, 0), Rgb(0, 1, 51 / 255.f));
  write_raw_png(directory / "ga.png", {2, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA}, {51, 0, 255, 7});
  EXPECT_EQ(read_image(directory / "ga.png", kLinear).at(0, 0), Rgb(51 / 255.f));
}

TEST(Png, PalettesAndInterlacing) {
  const TemporaryDirectory directory;
  const std::vector<png_color> palette = {{255, 0, 0}, {0, 51, 255}, {255, 255, 0}, {0, 0, 0}};
  write_raw_png(directory / "a.png", {4, 1, 2, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, palette}, {0b00011011});
  const Image image = read_image(directory / "a.png", kLinear);
  EXPECT_EQ(image.at(0, 0), Rgb(1, 0, 0));
  EXPECT_EQ(image.at(1, 0), Rgb(0, 51 / 255.f, 1));
  EXPECT_EQ(image.at(2, 0), Rgb(1, 1, 0));
  EXPECT_EQ(image.at(3, 0), Rgb(0, 0, 0));

  std::vector<png_byte> samples;
  for (int i = 0; i < 13 * 11 * 3; ++i) samples.push_back(static_cast<png_byte>(i * 7));
  write_raw_png(directory / "plain.png", {13, 11, 8, PNG_COLOR_TYPE_RGB}, samples);
  write_raw_png(directory / "adam7.png", {13, 11, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7}, samples);
  EXPECT_EQ(read_image(directory / "plain.png"), read_image(directory / "adam7.png"));
}

TEST(Png, ADirectoryThatIsNotThereIsNamed) {
  const TemporaryDirectory directory;
  try {
    write_png(directory / "not/there/a.png", Image(1, 1));
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("not/there"), std::string::npos) << error.what();
  }
  EXPECT_EQ(directory.file_count(), 0);
}

TEST(Png, AlphaIsKeptUnlessAllIsOpaque) {
  const TemporaryDirectory directory;
  PngKind kind;
  kind.width = 2, kind.height = 1, kind.bits = 8, kind.color_type = PNG_COLOR_TYPE_RGB_ALPHA;
  write_raw_png(directory / "a.png", kind, {51, 0, 0, 51, 0, 255, 0, 255});
  const Image image = read_image(directory / "a.png", {ColorEncoding::Kind::linear, 1});
  ASSERT_EQ(image.alpha.size(), 2u);
  EXPECT_FLOAT_EQ(image.alpha[0], 0.2f);
  EXPECT_EQ(image.alpha[1], 1);
  EXPECT_FLOAT_EQ(image.at(0, 0).r, 0.2f);
  write_raw_png(directory / "b.png", kind, {51, 0, 0, 255, 0, 255, 0, 255});
  EXPECT_TRUE(read_image(directory / "b.png").alpha.empty());
}

}  // namespace png_test
}  // namespace dspm
