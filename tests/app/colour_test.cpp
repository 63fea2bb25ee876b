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

// What a camera responds to, as a file of a spectrometer.
void put_sensor(const TinyDirectory& directory, const std::string& rows) {
  put_file(directory / "camera.csv", rows);
  put_file(directory / "photo.dsc", R"(Option "colour" "spectral"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8 "string filename" "photo.exr" "string sensorfile" "camera.csv"
Integrator "path" "integer iterations" 4
WorldBegin
LightSource "infinite" "spectrum L" "stdillum-F11"
)");
}

TEST(Colour, OfAFilmIsThatOfItsSensor) {
  const TinyDirectory directory;
  const auto pixel = [&] {
    const Outcome outcome = run(directory, {"photo.dsc", "--float"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_image(directory / "photo.exr").pixels.front();
  };
  put_sensor(directory, "# nm, r, g, b\n400,0,0,1\n500,0,1,0.2\n600,1,0.3,0\n700,0.1,0,0\n");
  const Rgb first = pixel();
  EXPECT_GT(first.r, 0);
  put_sensor(directory, "400 0 0 1\n500 0 1 0.2\n550 0.5 1 0\n600 1 0.3 0\n700 0.1 0 0\n");
  EXPECT_NE(pixel(), first);
}

TEST(Colour, OfASensorIsOneCheckpoint) {
  const TinyDirectory directory;
  put_sensor(directory, "400 0 0 1\n500 0 1 0\n600 1 0 0\n");
  EXPECT_EQ(run(directory, {"photo.dsc", "--checkpoint", "a.ckpt"}).code, 0);
  const Arguments go_on{"photo.dsc", "--resume", "a.ckpt", "--iterations", "5"};
  EXPECT_EQ(run(directory, go_on).code, 0);
  put_sensor(directory, "400 0 0 1\n500 0 1 0\n600 1 0.5 0\n");
  const Outcome other = run(directory, go_on);
  EXPECT_NE(other.code, 0);
  EXPECT_NE(other.err.find("the film's sensor"), std::string::npos) << other.err;
}

TEST(Colour, OfBrokenSensorsIsRefused) {
  const TinyDirectory directory;
  for (const auto& [rows, message] : {std::pair{"400 0 0\n500 0 1 0\n", "not rows of 4"},
                                      {"400 0 0 1\n400 0 1 0\n500 1 0 0\n", "must ascend"},
                                      {"400 0 0 1\n500 0 1 nonsense\n", "not a list of numbers"},
                                      {"400 0 0 0\n500 0 1 0\n", "not above 0"},
                                      {"400 0 0 -1\n500 0 1 0\n600 1 0 0\n", "not above 0"},
                                      {"400 1 1 1\n500 2 2 2\n600 3 3 3\n", "too alike"},
                                      {"", "has 0 numbers"}}) {
    put_sensor(directory, rows);
    const Outcome outcome = run(directory, {"photo.dsc"});
    EXPECT_EQ(outcome.code, 1) << rows;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("photo.dsc:2:"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace dspm::test
