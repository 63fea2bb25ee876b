#include "dspm/image/icc_profile.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/image/image_bytes.h"

namespace dspm::test {
namespace icc_profile_test {

/// Where a tag's content begins.
std::size_t place_of(const std::string& profile, const std::string& tag) {
  for (std::size_t i = 0; i < number_at(profile, 128); ++i)
    if (profile.substr(132 + 12 * i, 4) == tag) return number_at(profile, 136 + 12 * i);
  ADD_FAILURE() << tag;
  return 0;
}

double fixed_at(const std::string& profile, std::size_t at) {
  return static_cast<std::int32_t>(number_at(profile, at)) / 65536.0;
}

TEST(IccProfile, IsWellFormed) {
  const std::string profile = icc_profile(ColourSpace::dci_p3, "Display P3");
  EXPECT_EQ(number_at(profile, 0), profile.size());
  EXPECT_EQ(profile.substr(12, 12), "mntrRGB XYZ ");
  EXPECT_EQ(profile.substr(36, 4), "acsp");
  for (std::size_t i = 0; i < number_at(profile, 128); ++i) {
    EXPECT_EQ(number_at(profile, 136 + 12 * i) % 4, 0u);
    EXPECT_LE(number_at(profile, 136 + 12 * i) + number_at(profile, 140 + 12 * i), profile.size());
  }
}

/// As in Apple's own profile: red is (0.5151, 0.2412, -0.0011), and the columns add up to D50.
TEST(IccProfile, DisplayP3HasItsPrimaries) {
  const std::string profile = icc_profile(ColourSpace::dci_p3, "Display P3");
  const double red[] = {0.5151, 0.2412, -0.0011}, white[] = {0.9642, 1, 0.8249};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(fixed_at(profile, place_of(profile, "rXYZ") + 8 + 4 * c), red[c], 3e-4);
    double sum = 0;
    for (const char* tag : {"rXYZ", "gXYZ", "bXYZ"}) sum += fixed_at(profile, place_of(profile, tag) + 8 + 4 * c);
    EXPECT_NEAR(sum, white[c], 5e-5) << "a grey stays grey";
  }
}

}  // namespace icc_profile_test
}  // namespace dspm::test
