// The comparison of renders: it passes what is the same but for noise, and tells what is slightly wrong.
#include "dspm/testing/agreement.h"

#include <gtest/gtest.h>

#include "dspm/base/math/rng.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace agreement_test {

// Both tails that statistics tables print: 5% at 12.706 with 1 degree of freedom, 4.303 with 2, 3.182 with 3, 2.571
// with 5, 2.228 with 10; 1% at 3.169 with 10, 0.1% at 6.869 with 5.
TEST(Agreement, StudentsTable) {
  EXPECT_NEAR(student_tails(12.7062, 1), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(4.3027, 2), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(3.1824, 3), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(2.5706, 5), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(2.2281, 10), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(3.1693, 10), 0.01, 1e-5);
  EXPECT_NEAR(student_tails(6.8688, 5), 0.001, 1e-6);
  EXPECT_EQ(student_tails(0, 4), 1);
}

Image plain(float value) {
  Image image(4, 4);
  for (Rgb& c : image.pixels) c = Rgb(value);
  return image;
}

/// Renders of noise around a mean of `value`, by a tenth either way.
Tiles noise(float value, std::uint64_t seed, int renders = 16) {
  std::vector<std::vector<Image>> images;
  for (int render = 0; render < renders; ++render) {
    const PathRandom random(seed, Stream::setup, static_cast<std::uint64_t>(render), 0);
    Image image(8, 8);
    for (int i = 0; i < 64; ++i)
      image.pixels[static_cast<std::size_t>(i)] = Rgb(value * (0.9f + 0.2f * random.number(i, 0)));
    images.push_back({image});
  }
  return tiles_of(images);
}

TEST(Agreement, NoiseAgrees) {
  int failures = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) failures += !agreement(noise(1, seed), noise(1, seed + 1000)).passed;
  EXPECT_LE(failures, 8);  // at a level of 1%: 2, and more than 8 with a chance of 2e-4
  EXPECT_TRUE(agreement(noise(1, 5), Rgb(1)).passed);
}

TEST(Agreement, APictureThatIsTooDarkDoesNot) {
  EXPECT_FALSE(agreement(noise(1, 1), noise(0.95f, 2)).passed);
  EXPECT_TRUE(agreement(noise(1, 1), noise(0.95f, 2), {0.01, 0.06}).passed);
  const Verdict verdict = agreement(noise(0.95f, 2), Rgb(1));
  EXPECT_FALSE(verdict.passed);
  EXPECT_NE(verdict.message.find("against 1,"), std::string::npos) << verdict.message;
}

TEST(Agreement, WithoutNoiseOnlyRoundingIsAllowed) {
  EXPECT_TRUE(agreement(tiles_of({{plain(2)}}), Rgb(2.00001f)).passed);
  EXPECT_FALSE(agreement(tiles_of({{plain(2)}}), Rgb(2.001f)).passed);
}

TEST(Agreement, OneFrameOfSeveral) {
  const Image grey = plain(1), dark = plain(0.5f);
  EXPECT_TRUE(agreement(tiles_of({{grey, dark}}), tiles_of({{grey, dark}})).passed);
  EXPECT_FALSE(agreement(tiles_of({{grey, dark}}), tiles_of({{grey, grey}})).passed);
  EXPECT_FALSE(agreement(tiles_of({{grey, dark}}), tiles_of({{grey}})).passed);
}

// 5% of the light are missing.
TEST(Agreement, TellsADimmerLamp) {
  const auto lit = [](const char* intensity) {
    return rendered(box("Integrator \"path\" \"integer maxdepth\" 2\n",
                        std::string("LightSource \"point\" \"point3 from\" [0 0 -3] \"rgb I\" ") + intensity, 16),
                    16);
  };
  const Tiles right = lit("[200 200 200]");
  EXPECT_TRUE(agreement(right, lit("[200.1 200.1 200.1]")).passed);
  EXPECT_FALSE(agreement(right, lit("[190 190 190]")).passed);
}

}  // namespace agreement_test
}  // namespace dspm::test
