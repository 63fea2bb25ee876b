// TIFF files, made by libtiff's writer.
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstdint>
#include <vector>

#include "dspm/image/encoding.h"
#include "tests/image/image_bytes.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace tiff_test {

struct TiffKind {
  int channels = 3, compression = COMPRESSION_NONE, extra = -1, tile = 0;
};

/// A file of these samples, row by row from the top.
template <class T>
std::string tiff(int width, int height, std::vector<T> samples, const TiffKind& kind) {
  const test::TemporaryDirectory directory;
  const std::string name = (directory / "a.tif").string();
  TIFF* file = TIFFOpen(name.c_str(), "w");
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, kind.channels);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, kind.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(file, TIFFTAG_COMPRESSION, kind.compression);
  if (kind.extra >= 0) {
    std::uint16_t extra = static_cast<std::uint16_t>(kind.extra);
    TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &extra);
  }
  const std::size_t row = static_cast<std::size_t>(width * kind.channels);
  if (kind.tile == 0) {
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 2);
    for (int y = 0; y < height; ++y)
      TIFFWriteScanline(file, &samples[static_cast<std::size_t>(y) * row], static_cast<std::uint32_t>(y), 0);
  } else {
    TIFFSetField(file, TIFFTAG_TILEWIDTH, kind.tile);
    TIFFSetField(file, TIFFTAG_TILELENGTH, kind.tile);
    for (int top = 0; top < height; top += kind.tile) {
      for (int left = 0; left < width; left += kind.tile) {
        std::vector<T> tile(static_cast<std::size_t>(kind.tile * kind.tile * kind.channels));
        for (int y = top; y < std::min(height, top + kind.tile); ++y) {
          for (int x = left * kind.channels; x < std::min(width, left + kind.tile) * kind.channels; ++x)
            tile[static_cast<std::size_t>((y - top) * kind.tile * kind.channels + x - left * kind.channels)] =
                samples[static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x)];
        }
        TIFFWriteTile(file, tile.data(), static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), 0, 0);
      }
    }
  }
  TIFFClose(file);
  return test::contents(name);
}

template <class T>
std::vector<T> counted(std::size_t count) {
  std::vector<T> samples(count);
  for (std::size_t i = 0; i < count; ++i) samples[i] = static_cast<T>(i * 37 % 251);
  return samples;
}

template <class T>
void expect_read(int width, int height, const TiffKind& kind, float most) {
  const auto samples = counted<T>(static_cast<std::size_t>(width * height * kind.channels));
  const Image image = decode_image(tiff(width, height, samples, kind), test::kLinear);
  ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t sample =
          i * static_cast<std::size_t>(kind.channels) + static_cast<std::size_t>(kind.channels < 3 ? 0 : c);
      ASSERT_FLOAT_EQ(image.pixels[i][c], static_cast<float>(samples[sample]) / most) << i;
    }
  }
}

TEST(TiffFile, EightAndSixteenBitsAndFloatsInStripsAndTiles) {
  for (const int tile : {0, 16}) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      for (const int channels : {1, 3}) {
        const TiffKind kind{channels, compression, -1, tile};
        expect_read<std::uint8_t>(21, 19, kind, 255);
        expect_read<std::uint16_t>(21, 19, kind, 65535);
        expect_read<float>(21, 19, kind, 1);
      }
    }
  }
}

TEST(TiffFile, IntegersAreSrgbAndFloatsAreLinear) {
  EXPECT_FLOAT_EQ(decode_image(tiff<std::uint8_t>(1, 1, {51}, {1}), {}).at(0, 0).r, srgb_to_linear(0.2f));
  EXPECT_FLOAT_EQ(decode_image(tiff<float>(1, 1, {0.2f}, {1}), {}).at(0, 0).r, 0.2f);
}

TEST(TiffFile, AlphaOfBothKindsAndOtherChannels) {
  const auto read = [](int extra) {
    return decode_image(tiff<std::uint16_t>(1, 1, {13107, 0, 6554, 32768}, {4, COMPRESSION_NONE, extra}),
                        test::kLinear);
  };
  const Image plain = read(EXTRASAMPLE_UNASSALPHA), multiplied = read(EXTRASAMPLE_ASSOCALPHA), other = read(0);
  ASSERT_EQ(plain.alpha.size(), 1u);
  ASSERT_EQ(multiplied.alpha.size(), 1u);
  EXPECT_FLOAT_EQ(plain.alpha[0], 32768.f / 65535);
  EXPECT_FLOAT_EQ(plain.at(0, 0).r, 0.2f);
  EXPECT_NEAR(multiplied.at(0, 0).r, 0.4f, 1e-4f);
  EXPECT_TRUE(other.alpha.empty());
  EXPECT_FLOAT_EQ(other.at(0, 0).r, 0.2f);
}

TEST(TiffFile, TruncatedFilesAreErrors) {
  // The directory stands at the end of libtiff's files, and its last entry's value within the entry.
  const std::string file = tiff(5, 4, counted<std::uint8_t>(60), {3, COMPRESSION_LZW});
  ASSERT_EQ(test::message_for(file), "");
  for (std::size_t length = 0; length < file.size() / 2; ++length)
    EXPECT_NE(test::message_for(file.substr(0, length)), "") << length;
  for (std::size_t length = 0; length < file.size(); ++length) test::message_for(file.substr(0, length));
}

}  // namespace tiff_test
}  // namespace dspm
