// glTF files as scenes: what they become, alone and in a scene of the language.
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/lang/parse.h"
#include "dspm/session/load.h"
#include "tests/gltf/gltf_file.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

using test::GltfFile, test::Square, test::TemporaryDirectory, test::put_file;

SceneDescription parsed(const std::filesystem::path& file, int errors = 0) {
  Diagnostics diagnostics;
  SceneDescription scene = parse_files({file.string()}, {}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), errors);
  for (const Diagnostic& each : diagnostics.all())
    if (each.severity == Severity::error && errors == 0) ADD_FAILURE() << each.message;
  return scene;
}

/// A square in oak or steel that moves along x for a second.
std::string chair() {
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 1}, "SCALAR", 1), places = file.add_floats({0, 0, 0, 2, 0, 0}, "VEC3", 3);
  const std::string variants =
      R"(,"material":0,"extensions":{"KHR_materials_variants":{"mappings":[{"material":0,"variants":[0]},{"material":1,"variants":[1]}]}})";
  return file.text(fmt::format(
      R"("scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"seat","mesh":0}}],"meshes":[{{"primitives":[{}]}}],)"
      R"("materials":[{{"name":"wood"}},{{"name":"steel"}}],"extensions":{{"KHR_materials_variants":{{"variants":)"
      R"([{{"name":"oak"}},{{"name":"bare steel"}}]}}}},"animations":[{{"channels":[{{"sampler":0,"target":)"
      R"({{"node":0,"path":"translation"}}}}],"samplers":[{{"input":{},"output":{}}}]}}])",
      square.primitive(variants), times, places));
}

TEST(GltfScene, HasFramesAndVariants) {
  TemporaryDirectory directory;
  put_file(directory / "chair.gltf", chair());
  const SceneDescription scene = parsed(directory / "chair.gltf");
  EXPECT_EQ(scene.moments, 25);
  ASSERT_EQ(scene.axes.size(), 1u);
  EXPECT_EQ(scene.axes[0].name, "variant");
  ASSERT_EQ(scene.axes[0].variations.size(), 2u);
  EXPECT_EQ(scene.axes[0].variations[1].name, "bare steel");
  ASSERT_EQ(scene.dynamic_blocks.size(), 1u);
  EXPECT_EQ(scene.dynamic_blocks[0].name, "seat");
  const ShapeUse& seat = scene.shapes.back();
  EXPECT_NEAR(seat.world_from_object.at(Moment(12)).m[0][3], 1, 1e-6);
  EXPECT_EQ(seat.world_from_object.at(Moment()).m[2][2], -1);  // z is turned around
}

TEST(GltfScene, IsAPartOfAScene) {
  TemporaryDirectory directory;
  put_file(directory / "chair.gltf", chair());
  put_file(directory / "room.dsc", R"(
Frames 3 "float fps" 2
Camera "perspective"
WorldBegin
LightSource "infinite"
AttributeBegin Translate 0 5 0 Import "chair.gltf" AttributeEnd
Import "chair.gltf"
AxisBegin "light" VariationBegin "day" VariationEnd VariationBegin "night" VariationEnd AxisEnd
)");
  const SceneDescription scene = parsed(directory / "room.dsc");
  EXPECT_EQ(scene.moments, 3);
  EXPECT_EQ(scene.frames.combinations().size(), 4u);  // both axes
  ASSERT_EQ(scene.shapes.size(), 2u);                 // without the studio's ground
  const Matrix4 first = scene.shapes[0].world_from_object.at(Moment(1));
  EXPECT_NEAR(first.m[0][3], 1, 1e-6);  // half a second
  EXPECT_EQ(first.m[1][3], 5);
  EXPECT_EQ(scene.shapes[0].material.name, "chair: wood");
}

/// A square at the origin, and a light 2 in front of it.
std::string lamp(const std::string& light) {
  GltfFile file;
  const Square square(file);
  return file.text(fmt::format(
      R"("nodes":[{{"mesh":0}},{{"translation":[0,0,2],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}}],)"
      R"("meshes":[{{"primitives":[{}]}}],"extensions":{{"KHR_lights_punctual":{{"lights":[{{{}}}]}}}})",
      square.primitive(), light));
}

// Lights in candela and lux: a white surface is to have a radiance near 1.
TEST(GltfScene, IsExposedToItsLights) {
  TemporaryDirectory directory;
  const auto iso = [&](const std::string& light) {
    put_file(directory / "lamp.gltf", lamp(light));
    const SceneDescription scene = parsed(directory / "lamp.gltf");
    const Param* const found = scene.film->params.find("iso");
    return found == nullptr ? 0 : std::get<std::vector<float>>(found->values).front();
  };
  EXPECT_EQ(iso(R"("type":"directional","intensity":3)"), 0);               // as it is
  EXPECT_EQ(iso(R"("type":"directional","intensity":2049)"), 100 / 512.f);  // 2049 / pi = 652
  EXPECT_EQ(iso(R"("type":"point","intensity":2049)"), 100 / 128.f);        // 2049 / 4 / pi = 163
  EXPECT_EQ(iso(R"("type":"point","intensity":0.5)"), 100 * 32);            // 1/8 lux, 0.04
}

TEST(GltfScene, SaysWhatIsWrong) {
  TemporaryDirectory directory;
  put_file(directory / "a.dsc", "WorldBegin Import \"b.gltf\" Include \"c.dsc\" \"string animation\" \"x\"");
  put_file(directory / "b.gltf", "{}");
  put_file(directory / "c.dsc", "");
  parsed(directory / "a.dsc", 2);
}

/// The world of a whole file, with its meshes.
TEST(GltfScene, MakesAWorld) {
  TemporaryDirectory directory;
  put_file(directory / "chair.gltf", chair());
  Messages messages(true);
  const LoadedScene loaded({(directory / "chair.gltf").string()}, {}, messages);
  EXPECT_EQ(loaded.description->frames.count(), 50);
}

}  // namespace
}  // namespace dspm
