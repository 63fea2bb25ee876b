#include "dspm/image/encoding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dspm {
namespace encoding_test {

using Kind = ColorEncoding::Kind;

TEST(Encoding, KnownSrgbValues) {
  EXPECT_EQ(srgb_to_linear(0), 0.f);
  EXPECT_EQ(srgb_to_linear(1), 1.f);
  EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114f, 1e-6);
  EXPECT_NEAR(srgb_to_linear(0.04f), 0.04f / 12.92f, 1e-8);
  EXPECT_NEAR(linear_to_srgb(0.18f), 0.46135613f, 1e-6);
}

TEST(Encoding, TheTwoAreInverseAndRise) {
  float last = -1;
  for (int i = 0; i <= 10000; ++i) {
    const float v = static_cast<float>(i) / 10000, linear = srgb_to_linear(v);
    EXPECT_NEAR(linear_to_srgb(linear), v, 2e-6);
    EXPECT_GT(linear, last);
    EXPECT_EQ(srgb_to_linear(-v), -linear);
    last = linear;
  }
}

TEST(Encoding, TablesHoldWhatTheirNamesSay) {
  const auto srgb = decoding_table({}, 256), linear = decoding_table({Kind::linear, 1}, 256);
  const auto gamma = decoding_table({Kind::gamma, 2}, 65536);
  for (std::size_t i = 0; i < 256; ++i) {
    const float v = static_cast<float>(i) / 255;
    EXPECT_EQ(srgb[i], srgb_to_linear(v)) << "automatic is sRGB for integers";
    EXPECT_EQ(linear[i], v);
    EXPECT_NEAR(gamma[i * 257], v * v, 1e-6);
  }
}

TEST(Encoding, ReadsPbrtsWords) {
  EXPECT_EQ(ColorEncoding::parse("sRGB")->kind, Kind::srgb);
  EXPECT_EQ(ColorEncoding::parse("linear")->kind, Kind::linear);
  EXPECT_EQ(ColorEncoding::parse("gamma 2.2")->kind, Kind::gamma);
  EXPECT_EQ(ColorEncoding::parse("gamma 2.2")->exponent, 2.2f);
  for (const char* wrong :
       {"", "srgb ", "gamma", "gamma ", "gamma x", "gamma 0", "gamma -1", "gamma 2x", "gamma inf"}) {
    EXPECT_FALSE(ColorEncoding::parse(wrong)) << wrong;
  }
}

}  // namespace encoding_test
}  // namespace dspm
