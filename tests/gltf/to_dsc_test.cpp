// What --to-dsc writes renders the same bits as the file itself.
#include <gtest/gtest.h>

#include "tests/gltf/gltf_file.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

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
  const std::string picture =
      "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFUlEQVR4nGM4oaGhcUKDAUjcuXMHACGmBd0PuU1+AAAAAElFTkSuQmCC";
  return file.text(fmt::format(
      R"("scenes":[{{"nodes":[0,1]}}],"nodes":[{{"name":"turns","mesh":0}},{{"mesh":1,"translation":[2.5,0,0]}}],)"
      R"("meshes":[{{"primitives":[{}]}},{{"primitives":[{}],"weights":[0]}}],"materials":[{{"pbrMetallicRoughness":)"
      R"({{"baseColorTexture":{{"index":0}},"metallicFactor":0}}}}],"textures":[{{"source":0}}],)"
      R"("images":[{{"uri":"data:image/png;base64,{}"}}],"animations":[{{"channels":[)"
      R"({{"sampler":0,"target":{{"node":0,"path":"rotation"}}}},{{"sampler":1,"target":{{"node":1,"path":"weights"}}}}],)"
      R"("samplers":[{{"input":{},"output":{}}},{{"input":{},"output":{}}}]}}])",
      square.primitive(R"(,"material":0)"), second, picture, times, turns, times, weights));
}

TEST(ToDsc, RendersTheSameImages) {
  TemporaryDirectory directory;
  put_file(directory / "toy.gltf", toy());
  const Arguments quick{"--resolution", "24x18", "--iterations", "2", "--quiet", "--fps", "2"};
  const Outcome own = run(directory, Arguments{"toy.gltf", "-o", "own.####.pfm"} + quick);
  ASSERT_EQ(own.code, 0) << own.err;
  const Outcome written = run(directory, {"--to-dsc", "toy.gltf", "--fps", "2"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(written.out, "toy.dsc, and 5 files in toy/\n");
  std::filesystem::remove(directory / "toy.gltf");
  const Outcome again = run(directory, Arguments{"toy.dsc", "-o", "again.####.pfm"} + quick);
  ASSERT_EQ(again.code, 0) << again.err;
  for (const char* frame : {"0001", "0002", "0003"}) {
    const std::string image = contents(directory / fmt::format("own.{}.pfm", frame));
    EXPECT_FALSE(image.empty());
    EXPECT_TRUE(image == contents(directory / fmt::format("again.{}.pfm", frame))) << frame;
  }
}

TEST(ToDsc, WantsGltf) {
  TinyDirectory directory;
  EXPECT_EQ(run(directory, {"--to-dsc", "tiny.dsc"}).code, 2);
}

}  // namespace
}  // namespace dspm::test
