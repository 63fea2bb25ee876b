// Images of radiance for tests: random, with one pixel far brighter than the others and one that is black.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "dspm/image/exr.h"
#include "tests/lights/random.h"

namespace dspm::test {

inline Image random_environment(int width, int height, std::uint64_t seed = 1) {
  Image image(width, height);
  Sequence random(seed);
  for (Rgb& pixel : image.pixels) {
    pixel = {random.number(), random.number(), random.number()};
    pixel *= 2 * random.number();
  }
  image.at(0, height / 2) = Rgb();
  image.at(width / 2, height / 3) = {20, 30, 40};
  return image;
}

/// Such an image in a file, as long as this lives.
class EnvironmentFile {
 public:
  EnvironmentFile(int width, int height) : EnvironmentFile(random_environment(width, height)) {}
  explicit EnvironmentFile(const Image& image)
      : path_(testing::TempDir() + "dspm_environment_" + std::to_string(getpid()) + "_" + std::to_string(image.width) +
              "x" + std::to_string(image.height) + ".exr") {
    write_exr(path_, image, {}, ExrPixels::single);
  }
  ~EnvironmentFile() { std::filesystem::remove(path_); }
  EnvironmentFile(const EnvironmentFile&) = delete;
  EnvironmentFile& operator=(const EnvironmentFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace dspm::test
