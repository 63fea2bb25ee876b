// What the page gets holds the image.
#include "dspm/looking/serve/picture.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace picture_test {

/// By the definition of half floats. [IEEE 754, binary16]
double value_of(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == 31) return fraction != 0 ? std::nan("") : sign * std::numeric_limits<double>::infinity();
  return sign * (exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25));
}

TEST(Picture, EveryHalfFloatIsItself) {
  for (int bits = 0; bits < 0x10000; ++bits) {
    const double value = value_of(static_cast<std::uint16_t>(bits));
    const std::uint16_t back = half_of(static_cast<float>(value));
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(value_of(back)));
    } else {
      ASSERT_EQ(back, bits);
    }
  }
}

TEST(Picture, HalfFloatsAreTheNearest) {
  std::mt19937 random(7);
  for (int i = 0; i < 200'000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(value)) continue;
    const std::uint16_t half = half_of(value);
    if (std::abs(value) >= 65520) {
      EXPECT_TRUE(std::isinf(value_of(half)));
      continue;
    }
    const double error = std::abs(value_of(half) - double(value));
    for (const int step : {-1, 1}) {
      const auto other = static_cast<std::uint16_t>(half + step);
      if (!std::isfinite(value_of(other))) continue;
      ASSERT_LE(error, std::abs(value_of(other) - double(value))) << value;
    }
  }
  EXPECT_EQ(half_of(1 + 0x1p-11f), 0x3c00);  // a tie goes to the even one
  EXPECT_EQ(half_of(1 + 3 * 0x1p-11f), 0x3c02);
}

/// The values, channel by channel, as page/pictures.js gets them.
template <class Bits>
std::vector<Bits> unpacked(const Picture& picture) {
  const auto count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  std::vector<unsigned char> bytes(count * static_cast<std::size_t>(picture.channels) * sizeof(Bits));
  uLongf size = bytes.size();
  EXPECT_EQ(
      uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(picture.pixels.data()), picture.pixels.size()),
      Z_OK);
  EXPECT_EQ(size, bytes.size());
  std::vector<Bits> values;
  for (int c = 0; c < picture.channels; ++c) {
    Bits before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      Bits difference = 0;
      for (std::size_t b = 0; b < sizeof(Bits); ++b)
        difference =
            static_cast<Bits>(difference << 8 | bytes[(static_cast<std::size_t>(c) * sizeof(Bits) + b) * count + i]);
      values.push_back(before = static_cast<Bits>(before + difference));
    }
  }
  return values;
}

Image noise(int width, int height) {
  std::mt19937 random(11);
  std::lognormal_distribution<float> value;
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = {value(random), value(random), value(random)};
  return image;
}

TEST(Picture, HoldsTheHalvesOfTheImage) {
  const Image image = noise(13, 7);
  const Picture picture = make_picture({0, kRadiance, 0}, radiance_output(), image);
  EXPECT_EQ(picture.bytes, 2);
  const auto values = unpacked<std::uint16_t>(picture);
  ASSERT_EQ(values.size(), image.pixels.size() * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_EQ(values[i], half_of(image.pixels[i].r));
    EXPECT_EQ(values[2 * image.pixels.size() + i], half_of(image.pixels[i].b));
  }
}

TEST(Picture, SmallOnesAreMeansAndIdsAreNot) {
  Image image(8, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(i % 2 == 0 ? 1.f : 3.f);
  const auto means = unpacked<std::uint16_t>(make_picture({0, kRadiance, 1}, radiance_output(), image));
  EXPECT_EQ(means.size(), 8u * 3);
  for (const std::uint16_t mean : means) EXPECT_EQ(value_of(mean), 2);
  OutputInfo id{"object", {"id"}, ""};
  id.is_id = true;
  const Picture picture = make_picture({0, "object", 1}, id, image);
  EXPECT_EQ(picture.bytes, 4);
  for (const std::uint32_t bits : unpacked<std::uint32_t>(picture)) EXPECT_EQ(std::bit_cast<float>(bits), 1);
}

TEST(Picture, NoHalvingLeavesLessThanAPixel) {
  const Picture picture = make_picture({0, kRadiance, 16}, radiance_output(), noise(100, 3));
  EXPECT_EQ(picture.width, 1);
  EXPECT_EQ(picture.height, 1);
}

}  // namespace picture_test
}  // namespace dspm
