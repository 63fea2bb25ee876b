// OpenEXR files: what we write comes back, and files put together by hand from the format's description are read.
#include "dspm/image/exr.h"

#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "dspm/base/math/vec.h"
#include "dspm/image/read_picture.h"
#include "tests/image/exr_by_hand.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace exr_test {

using test::ExrByHand;
using test::TemporaryDirectory;

Image test_image(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = {0.1f * static_cast<float>(x), std::exp(static_cast<float>(y)) / 3,
                        1e-3f * static_cast<float>(x * y)};
    }
  }
  return image;
}

TEST(Exr, SinglePrecisionIsExact) {
  const TemporaryDirectory directory;
  const Image image = test_image(37, 9);
  write_exr(directory / "a.exr", image, {}, ExrPixels::single);
  EXPECT_EQ(read_image(directory / "a.exr"), image);
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(Exr, HalvesRoundToElevenBits) {
  const TemporaryDirectory directory;
  const Image image = test_image(37, 9);
  write_exr(directory / "a.exr", image, {});
  const Image back = read_image(directory / "a.exr");
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(back.pixels[i][c], image.pixels[i][c], std::ldexp(image.pixels[i][c], -11) + 6e-8f);
    }
  }
}

TEST(Exr, HalvesAreClampedAndNanStays) {
  const TemporaryDirectory directory;
  Image image(1, 1);
  image.at(0, 0) = {1e9f, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
  write_exr(directory / "a.exr", image, {});
  const Rgb back = read_image(directory / "a.exr").at(0, 0);
  EXPECT_EQ(back.r, 65504.f);
  EXPECT_EQ(back.g, -65504.f);
  EXPECT_TRUE(std::isnan(back.b));
}

TEST(Exr, TheHeaderComesBack) {
  const TemporaryDirectory directory;
  ExrHeader header;
  header.texts = {{"scene", "drop.dsc"}, {"software", "dspm 0.1"}};
  header.integers = {{"seed", 7}, {"iterations", 400}};
  header.numbers = {{"photons", 3e11}, {"seconds", 12.25}};
  header.frames_per_second = 25;
  header.x = 5, header.y = 6, header.full_width = 100, header.full_height = 50;
  write_exr(directory / "a.exr", test_image(20, 10), header);

  const ExrHeader back = read_exr_header(directory / "a.exr");
  for (const auto& [name, value] : header.texts) EXPECT_EQ(back.texts.at(name), value);
  for (const auto& [name, value] : header.integers) EXPECT_EQ(back.integers.at(name), value);
  for (const auto& [name, value] : header.numbers) EXPECT_EQ(back.numbers.at(name), value);
  EXPECT_EQ(back.frames_per_second, 25);
  EXPECT_EQ(back.x, 5);
  EXPECT_EQ(back.y, 6);
  EXPECT_EQ(back.full_width, 100);
  EXPECT_EQ(back.full_height, 50);
  EXPECT_EQ(read_image(directory / "a.exr").width, 20) << "a crop is read as it is";
}

TEST(Exr, ErrorsLeaveTheOldFile) {
  const TemporaryDirectory directory;
  test::put_file(directory / "a.exr", "old");
  ExrHeader reserved;
  reserved.integers["channels"] = 3;
  EXPECT_THROW(write_exr(directory / "a.exr", test_image(2, 2), reserved), std::runtime_error);
  EXPECT_THROW(write_exr(directory / "a.exr", Image(), {}), std::runtime_error);
  EXPECT_THROW(write_exr(directory / "no/a.exr", test_image(2, 2), {}), std::runtime_error);
  EXPECT_EQ(test::contents(directory / "a.exr"), "old");
  EXPECT_EQ(directory.file_count(), 1);
}

TEST(Exr, GreyAndStrangeWindows) {
  // The data window begins left of and above the display window.
  ExrByHand file;
  file.channels = {"Y"}, file.x = -3, file.y = -2, file.width = 2, file.height = 2;
  file.values = {1, 2, 3, 4};
  const Image image = decode_exr(file.bytes());
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(0, 0), Rgb(1));
  EXPECT_EQ(image.at(1, 0), Rgb(2));
  EXPECT_EQ(image.at(0, 1), Rgb(3));
  EXPECT_EQ(image.at(1, 1), Rgb(4));
}

TEST(Exr, ChannelsAreFoundByNameAndOthersIgnored) {
  ExrByHand file;
  file.channels = {"A", "B", "G", "R", "Z"}, file.width = 1, file.height = 2;
  file.values = {9, 1, 2, 3, 8, 9, 4, 5, 6, 8};  // row by row, channel by channel
  const Image image = decode_exr(file.bytes());
  EXPECT_EQ(image.at(0, 0), Rgb(3, 2, 1));
  EXPECT_EQ(image.at(0, 1), Rgb(6, 5, 4));
}

TEST(Exr, ChannelsOfOtherNames) {
  const auto first = [](const std::vector<std::string>& channels, const std::vector<float>& values) {
    ExrByHand file;
    file.channels = channels, file.width = file.height = 1, file.values = values;
    return decode_exr(file.bytes()).at(0, 0);
  };
  EXPECT_EQ(first({"height"}, {3}), Rgb(3));
  EXPECT_EQ(first({"A", "mask"}, {1, 3}), Rgb(3));
  EXPECT_EQ(first({"A"}, {3}), Rgb(3));
  EXPECT_EQ(first({"R"}, {3}), Rgb(3));
  EXPECT_EQ(first({"blue", "green", "red"}, {1, 2, 3}), Rgb(3, 2, 1));
  EXPECT_EQ(first({"b", "g", "r", "z"}, {1, 2, 3, 9}), Rgb(3, 2, 1));
  EXPECT_EQ(first({"key.B", "key.G", "key.R", "key.Z"}, {1, 2, 3, 9}), Rgb(3, 2, 1));
}

/// As the library's own writer stores colours in luminance and chroma: it rounds luminance to 7 bits.
TEST(Exr, LuminanceAndChromaAreColours) {
  const TemporaryDirectory directory;
  const std::string name = directory / "yc.exr";
  constexpr int kSide = 16;
  {
    Imf::RgbaOutputFile file(name.c_str(), kSide, kSide, Imf::WRITE_YC);
    const std::vector<Imf::Rgba> pixels(kSide * kSide, Imf::Rgba(0.75f, 0.5f, 0.125f));
    file.setFrameBuffer(pixels.data(), 1, kSide);
    file.writePixels(kSide);
  }
  const Image image = read_image(name);
  ASSERT_EQ(image.width, kSide);
  for (const Rgb& pixel : image.pixels) {
    EXPECT_NEAR(pixel.r, 0.75f, 5e-3f);
    EXPECT_NEAR(pixel.g, 0.5f, 5e-3f);
    EXPECT_NEAR(pixel.b, 0.125f, 5e-3f);
  }
}

// A picture that covers something is its display window: 10 x 10 pixels from 0, 0 on.
TEST(Exr, PicturesHaveTheirDisplayWindow) {
  const TemporaryDirectory directory;
  ExrByHand file;
  file.channels = {"Y"}, file.x = 8, file.y = -1, file.width = 3, file.height = 2, file.values = {1, 2, 3, 4, 5, 6};
  test::put_file(directory / "a.exr", file.bytes());
  const Image picture = read_picture(directory / "a.exr");
  ASSERT_EQ(picture.width, 10);
  ASSERT_EQ(picture.height, 10);
  EXPECT_EQ(picture.at(8, 0), Rgb(4));
  EXPECT_EQ(picture.at(9, 0), Rgb(5));
  EXPECT_EQ(picture.at(0, 0), Rgb(0));
  EXPECT_EQ(read_image(directory / "a.exr").width, 3);
}

TEST(Exr, OfSeveralPartsTheFirst) {
  ExrByHand first, second;
  first.channels = second.channels = {"B", "G", "R"};
  first.width = second.width = first.height = second.height = 1;
  first.values = {1, 2, 3}, second.values = {4, 5, 6};
  EXPECT_EQ(decode_exr(test::multi_part({first, second})).at(0, 0), Rgb(3, 2, 1));
}

std::string message_for(const ExrByHand& file) {
  try {
    decode_exr(file.bytes());
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

TEST(Exr, OfTiledAndMipMappedFilesTheLargestLevel) {
  ExrByHand picture{{"B", "G", "R"}, 0, 0, 5, 3, {}, {}};
  Image expected(5, 3);
  for (int y = 0; y < 3; ++y)
    for (int channel = 0; channel < 3; ++channel)
      for (int x = 0; x < 5; ++x) {
        const auto value = static_cast<float>(100 * y + 10 * channel + x);
        picture.values.push_back(value);
        (channel == 0 ? expected.at(x, y).b : channel == 1 ? expected.at(x, y).g : expected.at(x, y).r) = value;
      }
  EXPECT_EQ(decode_exr(test::tiled(picture)), expected);
  EXPECT_EQ(decode_exr(picture.bytes()), expected);
}

TEST(Exr, MissingChannelsAreNamed) {
  ExrByHand file;
  file.channels = {"diffuse.G", "diffuse.R"}, file.width = file.height = 1, file.values = {1, 2};
  EXPECT_NE(message_for(file).find("diffuse.R"), std::string::npos) << message_for(file);
}

TEST(Exr, AbsurdSizesAreRefused) {
  ExrByHand file;
  file.channels = {"Y"}, file.values = {1};
  for (const auto& [width, height] :
       {std::pair(1 << 19, 1 << 19), std::pair(2'000'000'000, 1), std::pair(1, 2'000'000'000)}) {
    file.width = width, file.height = height;
    EXPECT_NE(message_for(file), "no error") << width << " x " << height;
  }
}

test::ExrByHand with_chromaticities(std::initializer_list<float> eight) {
  test::ExrByHand exr;
  exr.channels = {"B", "G", "R"}, exr.width = exr.height = 1, exr.values = {0, 0, 1};
  std::string numbers;
  for (const float number : eight) numbers += test::float_bytes(number);
  exr.more = test::ExrByHand::attribute("chromaticities", "chromaticities", numbers);
  return exr;
}

// The red of Rec. 2020 in Rec. 709 [ITU-R BT.2407].
TEST(Exr, ColoursOfOtherChromaticitiesAreConverted) {
  const Rgb red =
      decode_exr(with_chromaticities({0.708f, 0.292f, 0.17f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.329f}).bytes())
          .at(0, 0);
  EXPECT_NEAR(red.r, 1.6605f, 1e-3f);
  EXPECT_NEAR(red.g, -0.1246f, 1e-3f);
  EXPECT_NEAR(red.b, -0.0182f, 1e-3f);
  const auto rec709 = with_chromaticities({0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f});
  EXPECT_EQ(decode_exr(rec709.bytes()).at(0, 0), Rgb(1, 0, 0));
  EXPECT_THROW(decode_exr(with_chromaticities({0, 0, 0, 0, 0, 0, 0, 0}).bytes()), std::exception);
}

}  // namespace exr_test
}  // namespace dspm
