// TGA, BMP, PNM, PFM and QOI files written by hand.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "dspm/image/encoding.h"
#include "tests/image/image_bytes.h"

namespace dspm {
namespace formats_test {

using test::bytes;
using test::expect_errors_when_truncated;
using test::kLinear;
using test::message_for;

const Rgb kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kWhite(1);

/// 2 x 2 unless told: red green above blue white.
void expect_four_colours(const Image& image) {
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(0, 0), kRed);
  EXPECT_EQ(image.at(1, 0), kGreen);
  EXPECT_EQ(image.at(0, 1), kBlue);
  EXPECT_EQ(image.at(1, 1), kWhite);
}

std::string tga_header(int kind, int bits, int descriptor, int palette = 0) {
  return bytes(
      {0, palette > 0 ? 1 : 0, kind, 0, 0, palette, 0, palette > 0 ? 24 : 0, 0, 0, 0, 0, 2, 0, 2, 0, bits, descriptor});
}
const std::string kRedBgr = bytes({0, 0, 255}), kGreenBgr = bytes({0, 255, 0}), kBlueBgr = bytes({255, 0, 0}),
                  kWhiteBgr = bytes({255, 255, 255});

TEST(Tga, RowsFromTheBottomOrTheTopFromTheLeftOrTheRight) {
  expect_four_colours(decode_image(tga_header(2, 24, 0) + kBlueBgr + kWhiteBgr + kRedBgr + kGreenBgr, {}));
  const std::string top_down = tga_header(2, 24, 32) + kRedBgr + kGreenBgr + kBlueBgr + kWhiteBgr;
  expect_four_colours(decode_image(top_down, {}));
  expect_four_colours(decode_image(tga_header(2, 24, 48) + kGreenBgr + kRedBgr + kWhiteBgr + kBlueBgr, {}));
  expect_errors_when_truncated(top_down);
}

TEST(Tga, RunsAndPalettesAndGrey) {
  // A literal of two pixels, then two runs of one.
  const std::string encoded =
      tga_header(10, 24, 32) + bytes({1}) + kRedBgr + kGreenBgr + bytes({128}) + kBlueBgr + bytes({128}) + kWhiteBgr;
  expect_four_colours(decode_image(encoded, {}));
  expect_errors_when_truncated(encoded);
  const std::string palette =
      tga_header(1, 8, 32, 4) + kWhiteBgr + kBlueBgr + kGreenBgr + kRedBgr + bytes({3, 2, 1, 0});
  expect_four_colours(decode_image(palette, {}));
  expect_errors_when_truncated(palette);
  const Image grey = decode_image(tga_header(11, 8, 32) + bytes({131, 51}), kLinear);
  for (const Rgb& pixel : grey.pixels) EXPECT_FLOAT_EQ(pixel.g, 0.2f);
}

TEST(Tga, AlphaAndEncoding) {
  const std::string file = tga_header(2, 32, 40) + bytes({51, 0, 255, 0, 0, 0, 0, 51, 0, 0, 0, 255, 0, 0, 0, 102});
  const Image image = decode_image(file, {});
  EXPECT_FLOAT_EQ(image.at(0, 0).b, srgb_to_linear(0.2f));
  EXPECT_FLOAT_EQ(decode_image(file, kLinear).at(0, 0).b, 0.2f);
  ASSERT_EQ(image.alpha.size(), 4u);
  EXPECT_FLOAT_EQ(image.alpha[0], 0);
  EXPECT_FLOAT_EQ(image.alpha[1], 0.2f);
  EXPECT_FLOAT_EQ(image.alpha[2], 1);
  EXPECT_FLOAT_EQ(image.alpha[3], 0.4f);
  expect_errors_when_truncated(file);
}

/// Rows of two pixels of 24 bits end in two bytes that fill them up.
std::string bmp(int bits, int height, const std::string& pixels) {
  return "BM" +
         bytes({0,
                0,
                0,
                0,
                0,
                0,
                0,
                0,
                54,
                0,
                0,
                0,
                40,
                0,
                0,
                0,
                2,
                0,
                0,
                0,
                height,
                height < 0 ? 255 : 0,
                height < 0 ? 255 : 0,
                height < 0 ? 255 : 0,
                1,
                0,
                bits,
                0}) +
         std::string(24, '\0') + pixels;
}

TEST(Bmp, RowsFromTheBottomOrTheTop) {
  const std::string fill(2, '\0');
  const std::string bottom_up = bmp(24, 2, kBlueBgr + kWhiteBgr + fill + kRedBgr + kGreenBgr + fill);
  expect_four_colours(decode_image(bottom_up, {}));
  expect_four_colours(decode_image(bmp(24, -2, kRedBgr + kGreenBgr + fill + kBlueBgr + kWhiteBgr + fill), {}));
  for (std::size_t length = 0; length + fill.size() < bottom_up.size(); ++length)
    EXPECT_NE(message_for(bottom_up.substr(0, length)), "") << length;
}

TEST(Bmp, Alpha) {
  const Image image =
      decode_image(bmp(32, -2, bytes({0, 0, 255, 255, 0, 255, 0, 51, 255, 0, 0, 0, 255, 255, 255, 255})), {});
  expect_four_colours(image);
  ASSERT_EQ(image.alpha.size(), 4u);
  EXPECT_FLOAT_EQ(image.alpha[1], 0.2f);
  EXPECT_FLOAT_EQ(image.alpha[2], 0);
}

TEST(Pnm, AllSixKinds) {
  const Image p1 = decode_image("P1 # bits\n3 2\n010\n1 1 0\n", {});
  const Image p4 = decode_image("P4 3 2\n" + bytes({0x5f, 0xdf}), {});  // what follows the third bit has no meaning
  EXPECT_EQ(p1.pixels, (std::vector<Rgb>{Rgb(1), Rgb(0), Rgb(1), Rgb(0), Rgb(0), Rgb(1)}));
  EXPECT_EQ(p4.pixels, p1.pixels);
  const Image p2 = decode_image("P2\n2 1 10\n5 10", kLinear),
              p5 = decode_image("P5\n2 1 10\n" + bytes({5, 10}), kLinear);
  EXPECT_EQ(p2.pixels, (std::vector<Rgb>{Rgb(0.5f), Rgb(1)}));
  EXPECT_EQ(p5.pixels, p2.pixels);
  expect_four_colours(decode_image("P3 2 2 7  7 0 0  0 7 0  0 0 7  7 7 7", {}));
  expect_four_colours(decode_image("P6 2 2 255\n" + bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}), {}));
}

TEST(Pam, GreyAndColoursWithAndWithoutAlpha) {
  const auto pam = [](const std::string& type, int depth, int most, const std::string& data) {
    return "P7\n# by hand\nDEPTH " + std::to_string(depth) + "\nMAXVAL " + std::to_string(most) +
           "\nWIDTH 2\nHEIGHT 1\nTUPLTYPE " + type + "\nENDHDR\n" + data;
  };
  const Image grey = decode_image(pam("GRAYSCALE_ALPHA", 2, 10, bytes({5, 10, 10, 4})), kLinear);
  EXPECT_EQ(grey.pixels, (std::vector<Rgb>{Rgb(0.5f), Rgb(1)}));
  EXPECT_EQ(grey.alpha, (std::vector<float>{1, 0.4f}));
  const std::string file = pam("RGB_ALPHA", 4, 65535, bytes({255, 255, 0, 0, 0, 0, 255, 255}) + std::string(8, '\xff'));
  const Image colours = decode_image(file, {});
  EXPECT_EQ(colours.pixels, (std::vector<Rgb>{Rgb(1, 0, 0), Rgb(1)}));
  EXPECT_TRUE(colours.alpha.empty()) << "opaque";
  EXPECT_EQ(decode_image(pam("RGB", 3, 1, bytes({0, 1, 0, 0, 0, 1})), {}).at(1, 0), Rgb(0, 0, 1));
  EXPECT_EQ(decode_image(pam("BLACKANDWHITE", 1, 1, bytes({0, 1})), {}).at(1, 0), Rgb(1)) << "unlike P4";
  expect_errors_when_truncated(file);
  EXPECT_NE(message_for(pam("CMYK", 4, 255, std::string(8, ' '))).find("TUPLTYPE"), std::string::npos);
  EXPECT_NE(message_for(pam("RGB", 5, 255, std::string(10, ' '))).find("DEPTH"), std::string::npos);
  EXPECT_NE(message_for("P7\nCOLOURS 3\n").find("not known"), std::string::npos);
}

TEST(Pnm, SixteenBits) {
  const std::string file = "P6 1 1 65535\n" + bytes({0x80, 0x01, 0, 1, 255, 255});
  const Rgb pixel = decode_image(file, kLinear).at(0, 0);
  EXPECT_FLOAT_EQ(pixel.r, 32769.f / 65535);
  EXPECT_FLOAT_EQ(pixel.g, 1.f / 65535);
  EXPECT_EQ(pixel.b, 1);
  EXPECT_FLOAT_EQ(decode_image(file, {}).at(0, 0).r, srgb_to_linear(32769.f / 65535));
  expect_errors_when_truncated(file);
}

TEST(Pnm, ErrorsSayTheCause) {
  EXPECT_NE(message_for("P6 99999 99999 255\n").find("too many"), std::string::npos);
  EXPECT_NE(message_for("P6 1 1 65536\n123456").find("65535"), std::string::npos);
  EXPECT_NE(message_for("P2 1 1 5\n6").find("exceeds"), std::string::npos);
  EXPECT_NE(message_for("P3 1 1 5\n1 x 1").find("\"x\""), std::string::npos);
  EXPECT_NE(message_for("P1 1 1\n2").find("bit"), std::string::npos);
  EXPECT_NE(message_for("P5 2 1 255\n1").find("early"), std::string::npos);
}

std::string floats(std::initializer_list<float> values, bool least_first) {
  std::string result;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) result.push_back(static_cast<char>(bits >> 8 * (least_first ? i : 3 - i)));
  }
  return result;
}

TEST(Pfm, LinearFromTheBottomInBothOrdersOfBytes) {
  for (const bool least_first : {false, true}) {
    const std::string file = std::string("PF\n1 2\n") + (least_first ? "-2" : "2") + "\n" +
                             floats({0.5f, -1, 1000, 0.25f, 0, 3}, least_first);
    const Image image = decode_image(file, {});
    EXPECT_EQ(image.at(0, 1), Rgb(1, -2, 2000));  // the first row is the lowest; the header says times 2
    EXPECT_EQ(image.at(0, 0), Rgb(0.5f, 0, 6));
    expect_errors_when_truncated(file);
  }
  EXPECT_EQ(decode_image("Pf 1 1 -1\n" + floats({0.5f}, true), {}).at(0, 0), Rgb(0.5f));
  EXPECT_NE(message_for("PF 1 1 0\n").find("scale"), std::string::npos);
}

std::string qoi(int width, int space, const std::string& chunks) {
  return "qoif" + bytes({0, 0, 0, width, 0, 0, 0, 1, 4, space}) + chunks;
}

TEST(Qoi, AllChunks) {
  // rgb 10 20 30; a difference of +1 -2 0; luma: green +5, red 5 + 2, blue 5 - 8; the slot of the first pixel; a run of
  // two; rgba 0 0 0 51. The slot of 10 20 30 255 is (30 + 100 + 210 + 2805) % 64 = 9.
  const std::string file = qoi(
      7, 1, bytes({254, 10, 20, 30, 64 | 3 << 4 | 0 << 2 | 2, 128 | 37, 10 << 4 | 0, 9, 192 | 1, 255, 0, 0, 0, 51}));
  const Image image = decode_image(file, {});
  const auto is = [&](int x, float r, float g, float b) {
    EXPECT_FLOAT_EQ(image.at(x, 0).r * 255, r) << x;
    EXPECT_FLOAT_EQ(image.at(x, 0).g * 255, g) << x;
    EXPECT_FLOAT_EQ(image.at(x, 0).b * 255, b) << x;
  };
  is(0, 10, 20, 30);
  is(1, 11, 18, 30);
  is(2, 18, 23, 27);
  for (const int x : {3, 4, 5}) is(x, 10, 20, 30);
  ASSERT_EQ(image.alpha.size(), 7u);
  EXPECT_EQ(image.alpha[5], 1);
  EXPECT_FLOAT_EQ(image.alpha[6], 0.2f);
  expect_errors_when_truncated(file);
}

TEST(Qoi, TheHeaderTellsTheEncodingUnlessItIsGiven) {
  const std::string chunk = bytes({254, 51, 51, 51});
  EXPECT_FLOAT_EQ(decode_image(qoi(1, 0, chunk), {}).at(0, 0).r, srgb_to_linear(0.2f));
  EXPECT_FLOAT_EQ(decode_image(qoi(1, 1, chunk), {}).at(0, 0).r, 0.2f);
  EXPECT_FLOAT_EQ(decode_image(qoi(1, 0, chunk), kLinear).at(0, 0).r, 0.2f);
  EXPECT_TRUE(decode_image(qoi(1, 0, chunk), {}).alpha.empty());
}

}  // namespace formats_test
}  // namespace dspm
