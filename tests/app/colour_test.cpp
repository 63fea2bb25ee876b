// --colour, as a user gives it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "tests/support/process.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

std::vector<Image> images_in(const TinyDirectory& directory) {
  std::vector<Image> images;
  for (const char* name : kTinyImages) images.push_back(read_image(directory / name));
  return images;
}

std::vector<Image> rendered(const std::vector<Arguments>& runs) {
  const TinyDirectory directory;
  for (const Arguments& arguments : runs) {
    const Outcome outcome = run(directory, Arguments{"tiny.dsc", "--float", "--seed", "5"} + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  return images_in(directory);
}

const Arguments kSpectral{"--colour", "spectral"};

// The light of a laser lies outside of Rec. 709: it is clamped, and nobody is blamed.
TEST(Colour, OutsideOfRec709IsClamped) {
  const TinyDirectory directory;
  put_file(directory / "laser.dsc", R"(Option "colour" "spectral"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "string filename" "laser.exr"
Integrator "path" "integer iterations" 32
WorldBegin
LightSource "infinite" "spectrum L" [515 0 520 1 530 1 535 0]
)");
  const Outcome outcome = run(directory, {"laser.dsc"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("cannot be shown"), std::string::npos) << outcome.err;
  for (const Rgb& c : read_image(directory / "laser.exr").pixels) {
    EXPECT_EQ(c.r, 0);
    EXPECT_GT(c.g, 0.5f);
    EXPECT_GE(c.b, 0);
  }
}

TEST(Colour, IsAChoiceOfTheCommandLine) {
  const auto rgb = rendered({{}}), spectral = rendered({kSpectral});
  EXPECT_NE(rgb, spectral);
  EXPECT_EQ(rendered({{"--color", "rgb"}}), rgb);
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--colour", "green"}).code, 2);
}

TEST(Colour, SpectralRunsAreResumed) {
  const auto whole = rendered({kSpectral + Arguments{"--iterations", "6"}});
  const Arguments checkpoint{"--checkpoint", "a.ckpt", "--checkpoint-every", "1"};
  EXPECT_EQ(rendered({kSpectral + checkpoint + Arguments{"--iterations", "3"},
                      kSpectral + Arguments{"--resume", "a.ckpt", "--iterations", "6"}}),
            whole);
  const TinyDirectory directory;
  run(directory, Arguments{"tiny.dsc", "--iterations", "3"} + kSpectral + checkpoint);
  const Outcome other = run(directory, {"tiny.dsc", "--iterations", "6", "--resume", "a.ckpt"});
  EXPECT_NE(other.code, 0);
  EXPECT_NE(other.err.find("--colour"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace dspm::test
