// --aov-files, --half, --float, --compression, --tiles; and what headers say of the camera.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "dspm/base/math/vec.h"
#include "dspm/image/exr.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace layer_files_test {

using Names = std::vector<std::string>;

TEST(LayerFiles, HoldWhatLayersDo) {
  const TinyDirectory together, apart;
  const Names asked = {"--aov", "N,Z,object"};
  ASSERT_EQ(run_tiny(together, asked).code, 0);
  const Outcome outcome = run_tiny(apart, asked + Names{"--aov-files"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* frame : {"0001", "0002", "0003"}) {
    const auto whole = together / fmt::format("tiny.{}.exr", frame);
    const auto same = [&](const std::string& file, const Names& channels) {
      EXPECT_EQ(read_exr_header(apart / file).channels.size(), channels.size()) << file;
      EXPECT_EQ(read_exr_channels(apart / file, channels), read_exr_channels(whole, channels)) << file;
    };
    same(fmt::format("tiny.{}.exr", frame), {"R", "G", "B"});
    same(fmt::format("tiny.N.{}.exr", frame), {"N.X", "N.Y", "N.Z"});
    same(fmt::format("tiny.Z.{}.exr", frame), {"Z"});
    same(fmt::format("tiny.object.{}.exr", frame), {"object.X"});
    const ExrHeader own = read_exr_header(apart / fmt::format("tiny.object.{}.exr", frame));
    EXPECT_EQ(own.texts.at("object manifest"), read_exr_header(whole).texts.at("object manifest"));
    EXPECT_EQ(own.integers.at("iterations"), 2);
  }
}

TEST(LayerFiles, ReplaceNoOtherFile) {
  const TinyDirectory directory;
  put_file(directory / "tiny.N.0001.exr", "a picture");
  const Outcome outcome = run_tiny(directory, {"--aov", "N", "--aov-files", "--checkpoint", "tiny.N.0001.exr"});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(contents(directory / "tiny.N.0001.exr"), "a picture");
}

/// The bytes of a value: twice as many zeros at the end of a single's mantissa if it came from a half.
bool are_halves(const Image& image) {
  for (const Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c)
      if (const float scaled = pixel[c] * 2048 / std::exp2(std::floor(std::log2(std::max(pixel[c], 1e-4f)))) / 2;
          pixel[c] > 1e-4f && scaled != std::floor(scaled))
        return false;
  return true;
}

TEST(LayerFiles, PrecisionIsChosenByLayer) {
  const TinyDirectory directory;
  const Names outputs = {"--aov", "albedo,P,N,object"};
  const auto halves = [&](const Names& more) {
    const Outcome outcome = run_tiny(directory, outputs + more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    Names found;
    const auto image = directory / kTinyImages[1];
    if (are_halves(read_image(image))) found.push_back("radiance");
    if (are_halves(read_exr_channels(image, {"Albedo.R", "Albedo.G", "Albedo.B"}))) found.push_back("albedo");
    if (are_halves(read_exr_channels(image, {"P.X", "P.Y", "P.Z"}))) found.push_back("P");
    return found;
  };
  EXPECT_EQ(halves({}), (Names{"radiance", "albedo"}));
  EXPECT_EQ(halves({"--half=P", "--float=albedo"}), (Names{"radiance", "P"}));
  EXPECT_EQ(halves({"--float", "--half=albedo"}), (Names{"albedo"}));
  const Outcome ids = run_tiny(directory, outputs + Names{"--half=object"});
  EXPECT_EQ(ids.code, 2);
  EXPECT_NE(ids.err.find("--half=object: ids are bits of a float"), std::string::npos) << ids.err;
  const Outcome absent = run_tiny(directory, outputs + Names{"--half=Z"});
  EXPECT_EQ(absent.code, 2);
  EXPECT_NE(absent.err.find("there are albedo, P, N, object"), std::string::npos) << absent.err;
  EXPECT_EQ(run_tiny(directory, outputs + Names{"--half=N", "--float=N"}).code, 2);
}

TEST(LayerFiles, FormatChangesNoPixel) {
  const TinyDirectory directory;
  std::set<std::uintmax_t> sizes;
  ASSERT_EQ(run_tiny(directory, {"--aov", "N"}).code, 0);
  const Image plain = read_image(directory / kTinyImages[0]);
  for (const Names& format :
       {Names{}, Names{"--compression", "none"}, Names{"--compression", "piz"}, Names{"--tiles", "4"}}) {
    ASSERT_EQ(run_tiny(directory, Names{"--aov", "N"} + format).code, 0);
    EXPECT_EQ(read_image(directory / kTinyImages[0]), plain);
    sizes.insert(std::filesystem::file_size(directory / kTinyImages[0]));
  }
  EXPECT_EQ(sizes.size(), 4U);
  EXPECT_EQ(run_tiny(directory, {"--compression", "best"}).code, 2);
  EXPECT_EQ(run_tiny(directory, {"--tiles", "5000"}).code, 2);
}

/// A point as a row times the header's matrix; x / w and y / w.
Vec2 seen(const std::array<float, 16>& m, const Rgb& p) {
  const auto column = [&](std::size_t j) { return p.r * m[j] + p.g * m[4 + j] + p.b * m[8 + j] + m[12 + j]; };
  return {column(0) / column(3), column(1) / column(3)};
}

constexpr const char* kCameras[] = {
    R"("perspective" "float fov" 45)",
    R"("perspective" "float fov" 30 "float screenwindow" [-1 1.5 .8 -.7])",
    R"("orthographic" "float screenwindow" [-2 1 -1 1.5])",
};

// Without jitter, P lies behind the centre of its pixel.
TEST(LayerFiles, HeadersSayWhereTheCameraSeesPoints) {
  for (const char* camera : kCameras) {
    SCOPED_TRACE(camera);
    const TemporaryDirectory directory;
    std::string scene = kTinyScene;
    scene.replace(scene.find(R"("perspective" "float fov" 45)"), 28, camera);
    scene.replace(scene.find("LookAt 0 0 -4  0 0 0  0 1 0"), 27,
                  "Option \"disablepixeljitter\" true\nLookAt 1 .5 -4  0 0.2 0  .1 1 0");
    put_file(directory / "tiny.dsc", scene);
    const Outcome outcome = run_tiny(directory, {"--aov", "P,Z", "--frames", "2", "--cropwindow", "0,1,0.25,1"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const ExrHeader header = read_exr_header(directory / kTinyImages[1]);
    const Image p = read_exr_channels(directory / kTinyImages[1], {"P.X", "P.Y", "P.Z"});
    const Image z = read_exr_channels(directory / kTinyImages[1], {"Z"});
    const std::array<float, 16>& to_camera = header.matrices.at("worldToCamera");
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x) {
        ASSERT_LT(z.at(x, y).r, 1e9f);
        const Vec2 at = seen(header.matrices.at("worldToNDC"), p.at(x, y));
        EXPECT_NEAR(at.x, 2 * (static_cast<float>(x + header.x) + 0.5f) / 12 - 1, 1e-3f);
        EXPECT_NEAR(at.y, 1 - 2 * (static_cast<float>(y + header.y) + 0.5f) / 8, 1e-3f);
        const Rgb& point = p.at(x, y);
        EXPECT_NEAR(point.r * to_camera[2] + point.g * to_camera[6] + point.b * to_camera[10] + to_camera[14],
                    z.at(x, y).r, 1e-3f * z.at(x, y).r);
      }
  }
}

TEST(LayerFiles, OfASphericalCameraHaveNoProjection) {
  const TinyDirectory directory;
  std::string scene = kTinyScene;
  scene.replace(scene.find(R"("perspective" "float fov" 45)"), 28, R"("spherical")");
  put_file(directory / "tiny.dsc", scene);
  ASSERT_EQ(run_tiny(directory, {}).code, 0);
  const ExrHeader header = read_exr_header(directory / kTinyImages[0]);
  EXPECT_EQ(header.matrices.count("worldToCamera"), 1U);
  EXPECT_EQ(header.matrices.count("worldToNDC"), 0U);
}

}  // namespace layer_files_test
}  // namespace dspm::test
