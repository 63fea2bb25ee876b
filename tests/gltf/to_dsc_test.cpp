// What --to-dsc writes renders the same bits as the file itself; and pictures of glTF files whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/image/image.h"
#include "tests/gltf/gltf_file.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

constexpr const char* kPicture =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFUlEQVR4nGM4oaGhcUKDAUjcuXMHACGmBd0PuU1+AAAAAElFTkSuQmCC";

/// A square that turns, and one with vertices of three colours, which a morph target moves.
std::string toy() {
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 1}, "SCALAR", 1);
  const int turns = file.add_floats({0, 0, 0, 1, 0, 0, 0.7071068f, 0.7071068f}, "VEC4", 4);
  const int moved = file.add_floats({0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3", 3);
  const int weights = file.add_floats({0, 1}, "SCALAR", 1);
  const int colours = file.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, "VEC3", 3);
  const std::string second =
      fmt::format(R"({{"attributes":{{"POSITION":{},"COLOR_0":{}}},"indices":{},"targets":[{{"POSITION":{}}}]}})",
                  square.positions, colours, square.indices, moved);
  return file.text(fmt::format(
      R"("scenes":[{{"nodes":[0,1]}}],"nodes":[{{"name":"turns","mesh":0}},{{"mesh":1,"translation":[2.5,0,0]}}],)"
      R"("meshes":[{{"primitives":[{}]}},{{"primitives":[{}],"weights":[0]}}],"materials":[{{"pbrMetallicRoughness":)"
      R"({{"baseColorTexture":{{"index":0}},"metallicFactor":0}}}}],"textures":[{{"source":0}}],)"
      R"("images":[{{"uri":"data:image/png;base64,{}"}}],"animations":[{{"channels":[)"
      R"({{"sampler":0,"target":{{"node":0,"path":"rotation"}}}},{{"sampler":1,"target":{{"node":1,"path":"weights"}}}}],)"
      R"("samplers":[{{"input":{},"output":{}}},{{"input":{},"output":{}}}]}}])",
      square.primitive(R"(,"material":0)"), second, kPicture, times, turns, times, weights));
}

TEST(ToDsc, RendersTheSameImages) {
  TemporaryDirectory directory;
  put_file(directory / "toy.gltf", toy());
  const Arguments quick{"--resolution", "24x18", "--iterations", "2", "--quiet", "--fps", "2"};
  const Outcome own = run(directory, Arguments{"toy.gltf", "-o", "own.####.pfm"} + quick);
  ASSERT_EQ(own.code, 0) << own.err;
  const Outcome written = run(directory, {"--to-dsc", "toy.gltf", "--fps", "2"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(written.out, "toy.dsc, and 6 files in toy/\n");
  const Outcome elsewhere = run(directory, {"--to-dsc", "toy.gltf", "--fps", "2", "-o", "there/left.dsc"});
  EXPECT_EQ(elsewhere.out, "there/left.dsc, and 6 files in there/left/\n") << elsewhere.err;
  EXPECT_EQ(run(directory, {"--to-dsc", "toy.gltf", "-o", "left.exr"}).code, 2);
  std::filesystem::remove(directory / "toy.gltf");
  const Outcome moved = run(directory, Arguments{"there/left.dsc", "-o", "moved.####.pfm"} + quick);
  ASSERT_EQ(moved.code, 0) << moved.err;
  const Outcome again = run(directory, Arguments{"toy.dsc", "-o", "again.####.pfm"} + quick);
  ASSERT_EQ(again.code, 0) << again.err;
  for (const char* frame : {"0001", "0002", "0003"}) {
    const std::string image = contents(directory / fmt::format("own.{}.pfm", frame));
    EXPECT_FALSE(image.empty());
    EXPECT_TRUE(image == contents(directory / fmt::format("again.{}.pfm", frame))) << frame;
  }
  EXPECT_TRUE(contents(directory / "moved.0002.pfm") == contents(directory / "own.0002.pfm"));
}

TEST(ToDsc, WantsGltf) {
  TinyDirectory directory;
  EXPECT_EQ(run(directory, {"--to-dsc", "tiny.dsc"}).code, 2);
}

/// A picture on a square by one of two sets of coordinates; the other one turns it. Two cameras, one of which looks away.
std::string poster(int set) {
  GltfFile file;
  const Square square(file);
  const int turned = file.add_floats({0, 0, 0, 1, 1, 1, 1, 0}, "VEC2", 2);
  return file.text(fmt::format(
      R"("nodes":[{{"mesh":0}},{{"name":"away","camera":0,"translation":[0,0,9],"rotation":[0,1,0,0]}},)"
      R"({{"name":"front","camera":0,"translation":[0,0,4]}}],"cameras":[{{"type":"perspective","perspective":)"
      R"({{"yfov":0.7,"aspectRatio":1.3,"znear":0.1}}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{},)"
      R"("TEXCOORD_{}":{},"TEXCOORD_{}":{}}},"indices":{},"material":0}}]}}],"materials":[{{"extensions":)"
      R"({{"KHR_materials_unlit":{{}}}},"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,"texCoord":{}}}}}}}],)"
      R"("textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,{}"}}])",
      square.positions, set, square.uvs, 1 - set, turned, square.indices, set, kPicture));
}

// Which of the two sets a picture takes makes no difference if they are exchanged as well; that of the camera does.
TEST(ToDsc, SecondCoordinatesAndCameras) {
  TemporaryDirectory directory;
  const auto image = [&](const char* file, const char* camera) {
    Arguments arguments{file,           "-o", "image.pfm", "--resolution", "26x20",
                        "--iterations", "2",  "--photons", "2000",         "--quiet"};
    if (camera != nullptr) arguments = arguments + Arguments{"--camera", camera};
    const Outcome outcome = run(directory, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return contents(directory / "image.pfm");
  };
  put_file(directory / "first.gltf", poster(0));
  put_file(directory / "second.gltf", poster(1));
  const std::string front = image("first.gltf", "front");
  EXPECT_TRUE(front == image("second.gltf", "2"));
  EXPECT_FALSE(front == image("first.gltf", nullptr));
  const Outcome written = run(directory, {"--to-dsc", "second.gltf", "--camera", "front"});
  ASSERT_EQ(written.code, 0) << written.err;
  std::filesystem::remove(directory / "second.gltf");
  EXPECT_TRUE(front == image("second.dsc", nullptr));
  const Outcome wrong = run(directory, {"first.gltf", "--camera", "side"});
  EXPECT_NE(wrong.code, 0);
  EXPECT_NE(wrong.err.find("it has no camera \"side\"; available: away, front"), std::string::npos) << wrong.err;
}

/// A matte card that lies on the ground, seen from above.
std::string card(double reflectance) {
  GltfFile file;
  const Square square(file);
  return file.text(fmt::format(
      R"("nodes":[{{"mesh":0,"rotation":[-0.7071068,0,0,0.7071068]}},{{"camera":0,"translation":[0,4,0],"rotation":)"
      R"([-0.7071068,0,0,0.7071068]}}],"cameras":[{{"type":"orthographic","orthographic":{{"xmag":0.9,"ymag":0.9,)"
      R"("znear":0.1,"zfar":9}}}}],"meshes":[{{"primitives":[{}]}}],"materials":[{{"pbrMetallicRoughness":)"
      R"({{"baseColorFactor":[{},{},{},1],"metallicFactor":0,"roughnessFactor":1}}}}])",
      square.primitive(R"(,"material":0)"), reflectance, reflectance, reflectance));
}

// The camera is among the softboxes, and none of them is in its way.
TEST(GltfPicture, TheStudioExposesAsAPhotographerDoes) {
  TemporaryDirectory directory;
  for (const double reflectance : {0.18, 0.9}) {
    put_file(directory / "card.gltf", card(reflectance));
    const Outcome outcome = run(directory, {"card.gltf", "--integrator", "path", "--iterations", "32", "--resolution",
                                            "8x8", "-o", "card.pfm", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    Rgb mean;
    for (const Rgb& pixel : read_image(directory / "card.pfm").pixels) mean += pixel / 64.f;
    EXPECT_GT(mean.g, 0.75f * static_cast<float>(reflectance));
    EXPECT_LT(mean.g, std::min(1.f, static_cast<float>(reflectance) + 0.04f));  // of which it mirrors 0.02
  }
}

/// A square that fills the picture and shines by itself; from left to right its vertices' alpha goes from 0 to 1.
std::string fading(const std::string& alpha_mode) {
  GltfFile file;
  const Square square(file);
  const int colours = file.add_floats({1, .5f, 0, 0, 1, .5f, 0, 1, 1, .5f, 0, 1, 1, .5f, 0, 0}, "VEC4", 4);
  return file.text(
      fmt::format(R"("nodes":[{{"mesh":0}},{{"camera":0,"translation":[0,0,4]}}],"cameras":[{{"type":"orthographic",)"
                  R"("orthographic":{{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}}}],"meshes":[{{"primitives":[)"
                  R"({{"attributes":{{"POSITION":{},"COLOR_0":{}}},"indices":{},"material":0}}]}}],"materials":[)"
                  R"({{{},"extensions":{{"KHR_materials_unlit":{{}}}}}}])",
                  square.positions, colours, square.indices, alpha_mode));
}

// BLEND shows the share alpha of the surface, MASK all of it or nothing.
TEST(GltfPicture, VerticesFade) {
  TemporaryDirectory directory;
  const auto image = [&](const std::string& alpha_mode) {
    put_file(directory / "fading.gltf", fading(alpha_mode));
    const Outcome outcome = run(directory, {"fading.gltf", "--studio", "off", "--integrator", "path", "--iterations",
                                            "64", "--resolution", "16x16", "-o", "fading.pfm", "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_image(directory / "fading.pfm");
  };
  const Image blend = image(R"("alphaMode":"BLEND")"), mask = image(R"("alphaMode":"MASK","alphaCutoff":0.25)");
  for (int x = 1; x < 15; ++x) {  // filters of the others reach beyond the square
    Rgb sum, masked;
    for (int y = 2; y < 14; ++y) sum += blend.at(x, y) / 12.f, masked += mask.at(x, y) / 12.f;
    const float alpha = (static_cast<float>(x) + 0.5f) / 16;
    EXPECT_NEAR(sum.r, alpha, 0.06f) << x;  // four standard deviations of 12 x 64 choices
    EXPECT_NEAR(sum.g, alpha / 2, 0.03f) << x;
    if (x == 3 || x == 4) continue;  // at the edge
    EXPECT_NEAR(masked.g, x > 4 ? 0.5f : 0.f, 1e-4f) << x;
  }
}

}  // namespace
}  // namespace dspm::test
