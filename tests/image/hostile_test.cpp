// Whatever a file holds, read_image yields an image or an error that names the file. Valid files of every format are
// cut off and altered at random; sanitizers watch in their builds.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "tests/image/exr_by_hand.h"
#include "tests/support/seeds.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace hostile_test {

using test::TemporaryDirectory;

/// JPEG has its own test: libjpeg recovers from nearly everything.
std::vector<std::string> valid_files(const TemporaryDirectory& directory) {
  Image image(21, 17);
  std::mt19937 random(1);
  for (Rgb& pixel : image.pixels) pixel = Rgb(static_cast<float>(random() % 1000) / 1000.f);
  write_png(directory / "a.png", image);
  write_exr(directory / "a.exr", image, {});
  test::ExrByHand exr;
  exr.channels = {"B", "G", "R"}, exr.width = exr.height = 4, exr.values.assign(48, 1.f);
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 10\n";
  for (int y = 0; y < 3; ++y) {
    hdr += std::string("\2\2\0\12", 4);
    for (int channel = 0; channel < 4; ++channel) hdr += std::string("\x85\x80\5\1\2\3\4\5", 8);
  }
  std::vector<std::string> files = {test::contents(directory / "a.png"), test::contents(directory / "a.exr"),
                                    exr.bytes(), test::multi_part({exr, exr}), hdr};
  for (const auto& small : std::filesystem::directory_iterator(DSPM_SOURCE_DIR "/tests/fuzz/corpus/pictures"))
    files.push_back(test::contents(small.path()));
  return files;
}

/// Either an image with as many pixels as it says, or an error with the file's name.
void read(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);  // file systems take their time over files that are cut and written anew
  test::put_file(path, bytes);
  try {
    const Image image = read_image(path);
    EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
  }
}

TEST(Hostile, ValidFilesAreRead) {
  const TemporaryDirectory directory;
  for (const std::string& bytes : valid_files(directory)) {
    test::put_file(directory / "b", bytes);
    EXPECT_NO_THROW(read_image(directory / "b")) << bytes.substr(0, 4);
  }
}

TEST(Hostile, FilesCutOffAnywhere) {
  const TemporaryDirectory directory;
  for (const std::string& bytes : valid_files(directory)) {
    for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 200) {
      read(directory / "b", bytes.substr(0, length));
    }
  }
}

TEST(Hostile, FilesAlteredAtRandom) {
  const TemporaryDirectory directory;
  std::mt19937 random(2);
  for (const std::string& bytes : valid_files(directory)) {
    for (int round = 0; round < test::seeds(300); ++round) {
      std::string altered = bytes;
      for (unsigned n = random() % 4 + 1; n > 0; --n) {
        // Headers are where sizes stand, so half of the changes go there.
        const std::size_t end = random() % 2 == 0 ? std::min<std::size_t>(altered.size(), 400) : altered.size();
        altered[random() % end] = static_cast<char>(random() % 3 == 0 ? 0xff : random());
      }
      read(directory / "b", altered);
    }
  }
}

TEST(Hostile, NotImagesAtAll) {
  const TemporaryDirectory directory;
  read(directory / "b", "");
  read(directory / "b", "P6 this is no format we read");
  EXPECT_THROW(read_image(directory / "missing.png"), std::runtime_error);
  EXPECT_THROW(read_image(directory / ""), std::runtime_error);
  EXPECT_THROW(read_image("/dev/zero"), std::runtime_error);
}

}  // namespace hostile_test
}  // namespace dspm
