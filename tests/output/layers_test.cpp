// --aov and Film "gbuffer": outputs next to radiance, as layers of each frame's EXR file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "dspm/base/system/find_program.h"
#include "dspm/image/exr.h"
#include "dspm/integrators/output_info.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace layers_test {

using Names = std::vector<std::string>;

Names channels_of(const std::filesystem::path& image) { return read_exr_header(image).channels; }

const Names kSurface = {"Albedo.B", "Albedo.G", "Albedo.R", "B", "G",        "N.X",        "N.Y", "N.Z", "P.X",
                        "P.Y",      "P.Z",      "R",        "Z", "object.X", "material.X", "u",   "v"};

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Layers, AreThoseThatWereAskedFor) {
  const TinyDirectory directory;
  ASSERT_EQ(run_tiny(directory, {}).code, 0);
  const Image plain = read_image(directory / kTinyImages[1]);
  EXPECT_EQ(channels_of(directory / kTinyImages[1]), (Names{"B", "G", "R"}));
  const Outcome outcome = run_tiny(directory, {"--aov", "N,Z", "--aov", "photons,radius"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* image : kTinyImages)
    EXPECT_EQ(channels_of(directory / image),
              (Names{"B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "photons.X", "radius.X"}));
  EXPECT_EQ(read_image(directory / kTinyImages[1]), plain);
  const Image photons = read_exr_channels(directory / kTinyImages[1], {"photons.X"});
  EXPECT_TRUE(std::any_of(photons.pixels.begin(), photons.pixels.end(), [](const Rgb& p) { return p.r > 0; }));
}

// Blender ignores channels of more than one letter without a layer, silently.
TEST(Layers, AreAllSeenByBlender) {
  if (find_program("blender").empty()) GTEST_SKIP() << "Blender is not installed";
  const TinyDirectory directory;
  ASSERT_EQ(run_tiny(directory, {"--aov", "N,P,Z,albedo,uv,object,material,photons,radius"}).code, 0);
  put_file(directory / "sockets.py",
           "import bpy\n"
           "scene = bpy.data.scenes[0]\n"
           "scene.use_nodes = True\n"
           "node = scene.node_tree.nodes.new('CompositorNodeImage')\n"
           "node.image = bpy.data.images.load('" +
               (directory / kTinyImages[0]).string() +
               "')\n"
               "open('sockets.txt', 'w').write(' '.join(sorted(s.name for s in node.outputs if s.enabled)))\n");
  ASSERT_EQ(shell(directory, "blender -b --python sockets.py > blender.txt 2>&1"), 0)
      << contents(directory / "blender.txt");
  EXPECT_EQ(contents(directory / "sockets.txt"), "Albedo Alpha Combined Depth N P material object photons radius u v");
}

TEST(Layers, OfAGbufferFilmAreTheSame) {
  const TinyDirectory asked, film;
  ASSERT_EQ(run_tiny(asked, {"--aov", "N,P,Z,albedo,uv,object,material"}).code, 0);
  std::string scene = kTinyScene;
  scene.replace(scene.find("Film \"rgb\""), 10, "Film \"gbuffer\" \"string coordinatesystem\" \"world\"");
  put_file(film / "tiny.dsc", scene);
  const Outcome outcome = run_tiny(film, {});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* image : kTinyImages) {
    EXPECT_EQ(channels_of(film / image), sorted(kSurface));
    for (const Names& layer : {Names{"N.X", "N.Y", "N.Z"}, Names{"P.X", "P.Y", "P.Z"}, Names{"Z", "u", "v"},
                               Names{"object.X", "material.X"}})
      EXPECT_EQ(read_exr_channels(film / image, layer), read_exr_channels(asked / image, layer));
  }
}

TEST(Layers, OfIdsHaveAManifest) {
  const TinyDirectory directory;
  ASSERT_EQ(run_tiny(directory, {"--aov", "object"}).code, 0);
  const std::string manifest = read_exr_header(directory / kTinyImages[0]).texts.at("object manifest");
  const Image ids = read_exr_channels(directory / kTinyImages[0], {"object.X"});
  const auto entry = [](float id) { return fmt::format("{:08x}\"", std::bit_cast<std::uint32_t>(id)); };
  for (const Rgb& pixel : ids.pixels) {
    if (pixel.r == 0) continue;
    EXPECT_NE(manifest.find(entry(pixel.r)), manifest.npos);
  }
  EXPECT_NE(manifest.find("\"ball\": \"" + entry(id_of("ball"))), manifest.npos) << manifest;
}

TEST(Layers, GoOnAfterAResume) {
  const TinyDirectory whole, parts;
  const Names outputs = {"--aov", "N,albedo,object,photons"};
  const auto with = [&](Names more) {
    more.insert(more.end(), outputs.begin(), outputs.end());
    return more;
  };
  ASSERT_EQ(run_tiny(whole, with({"--iterations", "4"})).code, 0);
  ASSERT_EQ(run_tiny(parts, with({"--iterations", "2", "--checkpoint", "tiny.ck"})).code, 0);
  const Outcome other = run_tiny(parts, {"--iterations", "4", "--resume", "tiny.ck"});
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("the choice of outputs (--aov, --denoise)"), std::string::npos) << other.err;
  const Outcome outcome = run_tiny(parts, with({"--iterations", "4", "--resume", "tiny.ck"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* image : kTinyImages)
    for (const Names& layer : {Names{"R", "G", "B"}, Names{"N.X", "N.Y", "N.Z"},
                               Names{"Albedo.R", "Albedo.G", "Albedo.B"}, Names{"object.X", "photons.X"}})
      EXPECT_EQ(read_exr_channels(parts / image, layer), read_exr_channels(whole / image, layer));
}

TEST(Layers, ThatNobodyHasAreErrors) {
  const TinyDirectory directory;
  const Outcome outcome = run_tiny(directory, {"--aov", "normal,albdo"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("integrator \"dsppm\" has no output \"normal\""), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("radiance, radius, photons, N, P, Z, albedo, uv, object, material"), std::string::npos);
  EXPECT_NE(outcome.err.find("did you mean \"albedo\"?"), std::string::npos) << outcome.err;
  EXPECT_EQ(run_tiny(directory, {"--integrator", "path", "--aov", "photons"}).code, 1);
  EXPECT_EQ(run_tiny(directory, {"--aov", "N,"}).code, 2);
  const Outcome png = run_tiny(directory, {"--aov", "N", "-o", "a.png"});
  EXPECT_EQ(png.code, 2);
  EXPECT_NE(png.err.find("a.png cannot hold N"), std::string::npos) << png.err;
  EXPECT_NE(png.err.find("-o a.exr gives them"), std::string::npos) << png.err;
}

}  // namespace layers_test
}  // namespace dspm::test
