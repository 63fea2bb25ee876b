#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "dspm/image/decoders.h"

namespace dspm {
namespace hdr_test {

const std::string kHeader = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n";

std::string bytes(std::initializer_list<int> values) {
  std::string result;
  for (const int value : values) result.push_back(static_cast<char>(value));
  return result;
}

TEST(Hdr, FlatPixels) {
  // 128 2^(129 - 136) = 1; 192 2^(131 - 136) = 6; exponent 0 is black whatever the mantissas say.
  const std::string flat = bytes({128, 64, 0, 129, 192, 0, 128, 131, 9, 9, 9, 0});
  const Image image = decode_hdr(kHeader + "-Y 1 +X 3\n" + flat);
  EXPECT_EQ(image.at(0, 0), Rgb(1, 0.5f, 0));
  EXPECT_EQ(image.at(1, 0), Rgb(6, 0, 4));
  EXPECT_EQ(image.at(2, 0), Rgb(0));
}

TEST(Hdr, RunsAndLiterals) {
  // Ten pixels: reds run, greens literal, blues mixed, exponents run.
  std::string row = bytes({2, 2, 0, 10, 138, 128, 10, 0, 16, 32, 48, 64, 80, 96, 112, 128, 144});
  row += bytes({133, 0, 2, 128, 64, 131, 32, 138, 129});
  const Image image = decode_hdr(kHeader + "-Y 2 +X 10\n" + row + row);
  ASSERT_EQ(image.height, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 10; ++x) {
      const float blue = x < 5 ? 0 : x == 5 ? 1 : x == 6 ? 0.5f : 0.25f;
      EXPECT_EQ(image.at(x, y), Rgb(1, static_cast<float>(x) * 0.125f, blue)) << x;
    }
  }
}

// Ward: pixels have been multiplied by all of them.
TEST(Hdr, ExposureAndColourCorrectionAreTakenBack) {
  const auto first = [](const std::string& lines) {
    return decode_hdr("#?RADIANCE\n" + lines + "\n-Y 1 +X 1\n" + bytes({128, 64, 32, 130})).at(0, 0);
  };
  EXPECT_EQ(first(""), Rgb(2, 1, 0.5f));
  EXPECT_EQ(first("EXPOSURE=2\r\n"), Rgb(1, 0.5f, 0.25f));
  EXPECT_EQ(first("EXPOSURE= 4.0\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=0.25\n"), Rgb(2, 1, 0.5f));
  EXPECT_EQ(first("COLORCORR= 2 1 .5\nEXPOSURE=.5\n"), Rgb(2, 2, 2));
  EXPECT_THROW(first("EXPOSURE=0\n"), std::runtime_error);
  EXPECT_THROW(first("COLORCORR=1 2\n"), std::runtime_error);
}

std::string message_for(const std::string& file) {
  try {
    decode_hdr(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Hdr, ErrorsSayTheCause) {
  const std::string row = bytes({2, 2, 0, 10});
  EXPECT_NE(message_for(kHeader).find("header"), std::string::npos);
  EXPECT_NE(message_for("#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234").find("xyze"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "+Y 1 +X 1\n1234").find("ordered"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y x +X 1\n1234").find("size"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 99999 +X 99999\n").find("too many"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 2 +X 1\n1234").find("too early"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 1 +X 9\n" + row).find("width"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 1 +X 10\n" + row + bytes({139, 1})).find("fit"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 1 +X 10\n" + row + bytes({0, 1})).find("fit"), std::string::npos);
  EXPECT_NE(message_for(kHeader + "-Y 1 +X 2\n" + bytes({128, 0, 0, 129, 1, 1, 1, 1})).find("old"), std::string::npos);
}

}  // namespace hdr_test
}  // namespace dspm
