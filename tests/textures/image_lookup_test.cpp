// Filters of pictures: what must hold for any of them, and the weights of the elliptical one written down a second time.
#include "dspm/textures/image_lookup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace dspm {
namespace image_lookup_test {

constexpr ImageFilter kFilters[] = {ImageFilter::point, ImageFilter::bilinear, ImageFilter::trilinear,
                                    ImageFilter::ewa};
constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::black, Wrap::clamp, Wrap::octahedral_sphere};

template <class Value>
std::shared_ptr<const MipMap> picture(int width, int height, Value&& value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = Rgb(value(x, y));
  return std::make_shared<const MipMap>(std::move(image));
}

std::shared_ptr<const MipMap> noise(int width, int height) {
  std::mt19937 random(1);
  return picture(width, height, [&](int, int) { return std::uniform_real_distribution<float>(0, 1)(random); });
}

ImageLookup lookup(std::shared_ptr<const MipMap> mip_map, ImageFilter filter, Wrap wrap = Wrap::clamp,
                   float anisotropy = 8) {
  return ImageLookup(std::move(mip_map), {.filter = filter, .wrap = wrap, .max_anisotropy = anisotropy});
}

/// Calls fn with footprints of every size and shape.
template <class Fn>
void for_each_footprint(Fn&& fn) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, 1), power(-4, 1), angle(0, 2 * kPi);
  for (int i = 0; i < 300; ++i) {
    const auto axis = [&] {
      const float length = std::pow(10.f, power(random)), turn = angle(random);
      return Vec2{length * std::cos(turn), length * std::sin(turn)};
    };
    fn(TextureCoordinates{{place(random), place(random)}, axis(), axis()});
  }
}

TEST(MipMap, HalvesDownToAPixelAndKeepsTheMean) {
  const auto map = picture(20, 5, [](int x, int y) { return static_cast<float>(x + 3 * y); });
  ASSERT_EQ(map->levels(), 6);
  const int widths[] = {20, 10, 5, 3, 2, 1}, heights[] = {5, 3, 2, 1, 1, 1};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(map->level(i).width, widths[i]);
    EXPECT_EQ(map->level(i).height, heights[i]);
  }
  EXPECT_NEAR(map->level(5).at(0, 0).r, 9.5f + 6, 1e-4f);
  EXPECT_EQ(MipMap(map->level(0), false).levels(), 1);
}

TEST(ImageLookup, AConstantStaysConstant) {
  const auto grey = picture(13, 6, [](int, int) { return 0.25f; });
  for (const ImageFilter filter : kFilters)
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::octahedral_sphere})
      for_each_footprint(
          [&](const TextureCoordinates& c) { EXPECT_NEAR(lookup(grey, filter, wrap).at<float>(c), 0.25f, 1e-5f); });
}

// Weights are not negative and add up to one.
TEST(ImageLookup, NothingIsBrighterThanThePicture) {
  const auto map = noise(16, 16);
  for (const ImageFilter filter : kFilters)
    for (const Wrap wrap : kWraps)
      for_each_footprint([&](const TextureCoordinates& c) {
        const float value = lookup(map, filter, wrap).at<float>(c);
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
      });
}

// Gaussians are symmetric, and where pixels are small against the ellipse so are their sums: the mean of a ramp is its
// value at the middle. Between pixels the sum is off by a small part of one.
TEST(ImageLookup, EwaOfARampIsItsValueAtTheMiddle) {
  constexpr int kSize = 256;
  const auto ramp = picture(kSize, kSize, [](int x, int y) {
    return (static_cast<float>(x) + 0.5f) / kSize + 2 * (static_cast<float>(y) + 0.5f) / kSize;
  });
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0.45f, 0.55f), size(0.004f, 0.02f), turn(0, 2 * kPi);
  for (int i = 0; i < 300; ++i) {
    const Vec2 st{place(random), place(random)};
    const float angle = turn(random), length = size(random), width = length / 6;
    const TextureCoordinates c{
        st, {length * std::cos(angle), length * std::sin(angle)}, {-width * std::sin(angle), width * std::cos(angle)}};
    EXPECT_NEAR(lookup(ramp, ImageFilter::ewa).at<float>(c), st.x + 2 * st.y, 0.2f / kSize);
  }
}

// A disk of three quarters of a pixel around the centre of one, so all sums are at level 0. As in pbrt, the squares of its
// axes are widened by 1.
TEST(ImageLookup, IsotropicEwaHasGaussianWeights) {
  constexpr int kSize = 32, kX = 17, kY = 12;
  std::mt19937 random(4);
  Image image(kSize, kSize);
  for (Rgb& pixel : image.pixels) pixel = Rgb(std::uniform_real_distribution<float>(0, 1)(random));
  const float pixel = 1.f / kSize, radius = 0.75f * pixel;
  const TextureCoordinates c{{(kX + 0.5f) * pixel, (kY + 0.5f) * pixel}, {radius, 0}, {0, -radius}};
  double sum = 0, weights = 0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      const double distance2 = (x * x + y * y) / (0.75 * 0.75 + 1);
      if (distance2 >= 1) continue;
      const double weight = std::exp(-2 * distance2) - std::exp(-2.);
      sum += weight * static_cast<double>(image.at(kX + x, kY + y).r), weights += weight;
    }
  const auto map = std::make_shared<const MipMap>(image);
  EXPECT_NEAR(lookup(map, ImageFilter::ewa).at<float>(c), sum / weights, 1e-3);
}

TEST(ImageLookup, WideFootprintsGiveTheMean) {
  const auto map = noise(16, 8);
  const float mean = map->level(map->levels() - 1).at(0, 0).r;
  for (const ImageFilter filter : kFilters)
    EXPECT_NEAR(lookup(map, filter).at<float>({{0.3f, 0.9f}, {2, 0}, {0, 2}}), mean, 1e-6f);
}

// Along the axis that is short, stripes across it stay; isotropic filters take the mean of all.
TEST(ImageLookup, OnlyEwaIsSharpAcrossALongFootprint) {
  const auto stripes = picture(64, 64, [](int, int y) { return y / 8 % 2 == 0 ? 1.f : 0.f; });
  const TextureCoordinates c{{0.5f, 4.f / 64}, {0.4f, 0}, {0, 0.01f}};
  EXPECT_GT(lookup(stripes, ImageFilter::ewa, Wrap::repeat, 64).at<float>(c), 0.99f);
  EXPECT_NEAR(lookup(stripes, ImageFilter::ewa, Wrap::repeat, 1).at<float>(c), 0.5f, 0.05f);
  for (const ImageFilter filter : {ImageFilter::bilinear, ImageFilter::trilinear})
    EXPECT_NEAR(lookup(stripes, filter, Wrap::repeat).at<float>(c), 0.5f, 0.05f);
}

TEST(ImageLookup, SmallFootprintsAreBilinear) {
  const auto map = noise(16, 16);
  for (const ImageFilter filter : {ImageFilter::bilinear, ImageFilter::trilinear})
    for_each_footprint([&](TextureCoordinates c) {
      c.dstdx = {0.02f, 0}, c.dstdy = {0, 0.03f};  // a pixel is 1/16
      EXPECT_EQ(lookup(map, filter).at<float>(c), lookup(map, ImageFilter::bilinear).at<float>({c.st}));
    });
}

TEST(ImageLookup, TrilinearHasNoSteps) {
  const auto map = noise(64, 64);
  const ImageLookup smooth = lookup(map, ImageFilter::trilinear);
  float last = smooth.at<float>({{0.3f, 0.4f}, {1e-3f, 0}, {0, 1e-3f}});
  for (float width = 1e-3f; width < 1; width *= 1.01f) {
    const float next = smooth.at<float>({{0.3f, 0.4f}, {width, 0}, {0, width}});
    EXPECT_NEAR(next, last, 0.03f) << width;
    last = next;
  }
}

TEST(ImageLookup, Wraps) {
  const auto map = picture(4, 2, [](int x, int y) { return static_cast<float>(x + 10 * y); });
  const auto at = [&](Wrap wrap, int x, int y) {
    const Vec2 st{(static_cast<float>(x) + 0.5f) / 4, (static_cast<float>(y) + 0.5f) / 2};
    return lookup(map, ImageFilter::bilinear, wrap).at<float>({st});
  };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const auto value = static_cast<float>(x + 10 * y);
      for (const Wrap wrap : kWraps) EXPECT_NEAR(at(wrap, x, y), value, 1e-5f);
      EXPECT_NEAR(at(Wrap::repeat, x - 8, y + 6), value, 1e-4f);
      EXPECT_NEAR(at(Wrap::octahedral_sphere, x + 8, y - 4), value, 1e-4f);  // two turns over each edge
      EXPECT_NEAR(at(Wrap::octahedral_sphere, x, -1 - y), at(Wrap::repeat, 3 - x, y), 1e-4f);  // over the upper edge
      EXPECT_NEAR(at(Wrap::octahedral_sphere, 7 - x, y), at(Wrap::repeat, x, 1 - y), 1e-4f);   // over the right edge
    }
  EXPECT_EQ(at(Wrap::clamp, 7, 5), 13);
  EXPECT_EQ(at(Wrap::clamp, -2, -1), 0);
  EXPECT_EQ(at(Wrap::black, 5, 0), 0);
}

// All three copies of a corner of the square are the same direction's.
TEST(ImageLookup, AnOctahedralSphereHasNoSeams) {
  const auto map = noise(16, 16);
  const ImageLookup sphere = lookup(map, ImageFilter::bilinear, Wrap::octahedral_sphere);
  for (int i = 0; i <= 40; ++i) {
    const float along = static_cast<float>(i) / 40;
    EXPECT_NEAR(sphere.at<float>({{along, 0}}), sphere.at<float>({{1 - along, 0}}), 1e-5f);
    EXPECT_NEAR(sphere.at<float>({{1, along}}), sphere.at<float>({{1, 1 - along}}), 1e-5f);
  }
}

TEST(ImageLookup, NumbersAreAlphaIfThereIsSome) {
  Image image(2, 1);
  image.pixels = {Rgb(1, 0.5f, 0), Rgb(0, 0, 0.3f)};
  EXPECT_NEAR(lookup(std::make_shared<MipMap>(image), ImageFilter::point).at<float>({{0.2f, 0.5f}}), 0.5f, 1e-6f);
  image.alpha = {0.25f, 0.75f};
  const auto map = std::make_shared<MipMap>(image);
  EXPECT_EQ(lookup(map, ImageFilter::point).at<float>({{0.2f, 0.5f}}), 0.25f);
  EXPECT_EQ(lookup(map, ImageFilter::point).at<float>({{0.2f, 0.5f}, {4, 0}, {0, 4}}), 0.5f);
  EXPECT_EQ(lookup(map, ImageFilter::point).at<Rgb>({{0.2f, 0.5f}}), Rgb(1, 0.5f, 0));
}

TEST(ImageLookup, AnyCoordinateIsFinite) {
  const auto map = noise(5, 3);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const ImageFilter filter : kFilters)
    for (const Wrap wrap : kWraps)
      for (const float odd : {kInfinity, -kInfinity, nan, 3e38f})
        for (const float size : {0.f, 1e-30f, 0.1f, 1e8f})
          EXPECT_TRUE(std::isfinite(lookup(map, filter, wrap).at<float>({{odd, 0.5f}, {size, 0}, {0, size / 2}})));
}

}  // namespace image_lookup_test
}  // namespace dspm
