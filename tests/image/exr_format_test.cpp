// How pixels lie in EXR files: any compression, rows or tiles, halves or singles next to one another, and matrices in
// the header.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dspm/image/exr.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace exr_format_test {

using test::TemporaryDirectory;

/// Smooth, with some noise: no compression has it easy.
Image some_image(int width, int height, float offset) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float noise = 0.01f * std::sin(static_cast<float>(x * 7919 + y * 104729));
      image.at(x, y) = {offset + 0.02f * static_cast<float>(x) + noise, offset + 0.03f * static_cast<float>(y),
                        offset + noise};
    }
  return image;
}

/// The byte of the header that says how pixels are compressed. [OpenEXR File Layout]
int compression_in(const std::filesystem::path& path) {
  const std::string bytes = test::contents(path), key("compression\0compression\0\1\0\0\0", 28);
  const std::size_t at = bytes.find(key);
  return at == bytes.npos ? -1 : bytes[at + key.size()];
}

constexpr const char* kNames[] = {"none", "rle", "zips", "zip", "piz", "dwaa", "dwab"};
constexpr int kNumbers[] = {0, 1, 2, 3, 4, 8, 9};

TEST(ExrFormat, EveryCompressionInRowsAndTilesComesBack) {
  const TemporaryDirectory directory;
  const Image colours = some_image(45, 37, 0.5f), others = some_image(45, 37, -3);
  const ExrLayer layers[] = {{{"R", "G", "B"}, &colours, ExrPixels::single},
                             {{"id.X", "id.r", "id.Z"}, &others, ExrPixels::single}};
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    for (const int tile : {0, 16, 64}) {
      SCOPED_TRACE(std::string(kNames[i]) + " " + std::to_string(tile));
      write_exr(directory / "a.exr", layers, {}, {*exr_compression(kNames[i]), tile});
      EXPECT_EQ(compression_in(directory / "a.exr"), kNumbers[i]);
      EXPECT_EQ(test::contents(directory / "a.exr").find("tiledesc") != std::string::npos, tile > 0);
      EXPECT_EQ(read_exr_channels(directory / "a.exr", {"id.X", "id.r", "id.Z"}), others) << "no loss";
      const Image back = read_image(directory / "a.exr");
      if (kNumbers[i] < 8) {
        EXPECT_EQ(back, colours);
      }
      for (std::size_t p = 0; p < back.pixels.size(); ++p)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.pixels[p][c], colours.pixels[p][c], 0.02f);
    }
}

TEST(ExrFormat, UnknownCompressionsHaveNoNumber) {
  EXPECT_FALSE(exr_compression("lzma"));
  EXPECT_FALSE(exr_compression(""));
  EXPECT_FALSE(exr_compression("pxr24")) << "it would shorten ids";
}

TEST(ExrFormat, CompressionsSaveRoomForWhatTheySay) {
  const TemporaryDirectory directory;
  const Image image = some_image(256, 256, 0.5f);
  const auto size = [&](const char* name) {
    const ExrLayer layer{{"R", "G", "B"}, &image, ExrPixels::half};
    write_exr(directory / "a.exr", {&layer, 1}, {}, {*exr_compression(name), 0});
    return std::filesystem::file_size(directory / "a.exr");
  };
  const auto none = size("none"), zip = size("zip"), dwab = size("dwab");
  EXPECT_GT(none, 256U * 256 * 6);
  EXPECT_LT(zip, none);
  EXPECT_LT(dwab, zip * 3 / 4);
}

TEST(ExrFormat, MatricesComeBack) {
  const TemporaryDirectory directory;
  ExrHeader header;
  for (std::size_t i = 0; i < 16; ++i) header.matrices["worldToCamera"][i] = static_cast<float>(i) / 3;
  write_exr(directory / "a.exr", some_image(2, 2, 0), header);
  EXPECT_EQ(read_exr_header(directory / "a.exr").matrices, header.matrices);
}

}  // namespace exr_format_test
}  // namespace dspm
