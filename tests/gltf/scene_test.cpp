// glTF files as scenes: what they become, alone and in a scene of the language.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "dspm/base/math/moments.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/parse.h"
#include "dspm/session/load.h"
#include "dspm/shapes/ply.h"
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

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// Softboxes beside the file's own lights, as bright as these are in the picture.
TEST(GltfScene, HasSurroundingsBesideItsLights) {
  TemporaryDirectory directory;
  const auto translated = [&](const std::string& light, const std::string& studio) {
    put_file(directory / "lamp.gltf", lamp(light));
    gltf::Settings settings;
    settings.studio = studio;
    return gltf::translate(directory / "lamp.gltf", "lamp", settings);
  };
  const std::string dim = R"("type":"directional","intensity":3)", bright = R"("type":"directional","intensity":2049)";
  const std::string text = translated(dim, "auto").text;
  EXPECT_EQ(count_of("\"point3 portal\"", text), 4u) << text;
  EXPECT_EQ(count_of("\"float scale\" 0.35", text), 5u) << text;  // and the sky's
  EXPECT_EQ(count_of("Shape \"disk\"", text), 1u) << text;
  EXPECT_EQ(count_of(fmt::format("\"float scale\" {}", 0.35f * 512), translated(bright, "auto").text), 5u);
  EXPECT_EQ(count_of("\"float scale\" 1", translated(dim, "on").text), 5u);
  const gltf::Translation bare = translated(dim, "off");
  EXPECT_EQ(count_of("\"infinite\"", bare.text) + count_of("\"disk\"", bare.text), 0u) << bare.text;
  EXPECT_EQ(bare.files.size(), 1u);  // the mesh
}

TEST(GltfScene, ThePictureOfTheLightMayBeBlurredOrHidden) {
  TemporaryDirectory directory;
  put_file(directory / "chair.gltf", chair());
  const auto text_with = [&](gltf::Backdrop backdrop) {
    gltf::Settings settings;
    settings.hdr = "sky.hdr", settings.backdrop = backdrop;
    return gltf::translate(directory / "chair.gltf", "chair", settings).text;
  };
  const std::string shown = text_with(gltf::Backdrop::shown);
  EXPECT_EQ(count_of("LightSource", shown), 1u) << shown;
  EXPECT_EQ(count_of("background", shown), 0u) << shown;
  EXPECT_EQ(count_of("Shape \"disk\"", shown), 1u) << shown;
  EXPECT_EQ(count_of("\"float backgroundblur\"", text_with(gltf::Backdrop::blurred)), 1u);
  EXPECT_EQ(count_of("\"rgb background\"", text_with(gltf::Backdrop::hidden)), 1u);
}

// For one frame of 25 it jumps down by 7.
TEST(GltfScene, TheGroundIsBelowAllFrames) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 0.5f, 0.54f, 1}, "SCALAR", 1),
            places = file.add_floats({0, 0, 0, 0, -7, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3);
  put_file(
      directory / "a.gltf",
      file.text(fmt::format(R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"animations":[{{"channels":)"
                            R"([{{"sampler":0,"target":{{"node":0,"path":"translation"}}}}],"samplers":[)"
                            R"({{"input":{},"output":{},"interpolation":"STEP"}}]}}])",
                            square.primitive(), times, places)));
  const SceneDescription scene = parsed(directory / "a.gltf");
  const auto ground = std::find_if(scene.shapes.begin(), scene.shapes.end(),
                                   [](const ShapeUse& shape) { return shape.type == "disk"; });
  ASSERT_NE(ground, scene.shapes.end());
  const double height = ground->world_from_object.at(Moment()).m[1][3];
  EXPECT_LT(height, -8);
  EXPECT_GT(height, -8.01);
}

TEST(GltfScene, SaysWhatIsWrong) {
  TemporaryDirectory directory;
  put_file(directory / "a.dsc", "WorldBegin Import \"b.gltf\" Include \"c.dsc\" \"string animation\" \"x\"");
  put_file(directory / "b.gltf", "{}");
  put_file(directory / "c.dsc", "");
  parsed(directory / "a.dsc", 2);
}

TEST(GltfScene, StillNodesAreCalledByTheirNames) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 1}, "SCALAR", 1), places = file.add_floats({0, 0, 0, 2, 0, 0}, "VEC3", 3);
  put_file(directory / "a.gltf",
           file.text(fmt::format(
               R"("nodes":[{{"name":"shelf","mesh":0,"children":[1]}},{{"name":"cup","mesh":1,"children":[2]}},)"
               R"({{"name":"spoon","mesh":2}}],"meshes":[{{"primitives":[{0}]}},{{"primitives":[{0}]}},)"
               R"({{"primitives":[{0}]}}],"animations":[{{"channels":[{{"sampler":0,"target":{{"node":1,)"
               R"("path":"translation"}}}}],"samplers":[{{"input":{1},"output":{2}}}]}}])",
               square.primitive(), times, places)));
  const SceneDescription scene = parsed(directory / "a.gltf");
  std::vector<std::string> names;
  for (const ShapeUse& shape : scene.shapes) names.push_back(shape.name);
  EXPECT_EQ(std::count(names.begin(), names.end(), "shelf"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "spoon"), 0);  // moves with the cup, whose block names it
}

// What the first frame does not show is keyed all the same: light that is dark at first, a tint that is white at first.
TEST(GltfScene, MaterialsMayBeginAsUsual) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 1}, "SCALAR", 1), colours = file.add_floats({0, 0, 0, 1, 0.5f, 0}, "VEC3", 3),
            strengths = file.add_floats({1, 9}, "SCALAR", 1);
  const auto channel = [](int sampler, const char* pointer) {
    return fmt::format(R"({{"sampler":{},"target":{{"path":"pointer","extensions":{{"KHR_animation_pointer":)"
                       R"({{"pointer":"/materials/0/{}"}}}}}}}})",
                       sampler, pointer);
  };
  put_file(
      directory / "a.gltf",
      file.text(fmt::format(
          R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"materials":[{{"emissiveFactor":[0,0,0],)"
          R"("extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":1}}}}}}],)"
          R"("animations":[{{"channels":[{},{}],"samplers":[{{"input":{},"output":{}}},{{"input":{},"output":{}}}]}}])",
          square.primitive(R"(,"material":0)"), channel(0, "emissiveFactor"),
          channel(1, "extensions/KHR_materials_emissive_strength/emissiveStrength"), times, colours, times,
          strengths)));
  const std::string text = gltf::translate(directory / "a.gltf", "a", {}).text;
  EXPECT_NE(text.find("\"rgb emission@1\" [0 0 0]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"rgb emission@25\" [1 0.5 0]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"float emissionstrength@25\" 9"), std::string::npos) << text;
  EXPECT_EQ(text.find("normalscale"), std::string::npos) << text;
}

// Alpha is 0.25 across the tangent and 0.25 + 0.75 / 4 = 0.4375 along it.
TEST(GltfScene, StretchesFacetsAsGltfDoes) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  put_file(
      directory / "a.gltf",
      file.text(fmt::format(
          R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"materials":[{{"pbrMetallicRoughness":)"
          R"({{"roughnessFactor":0.5}},"extensions":{{"KHR_materials_anisotropy":{{"anisotropyStrength":0.5}}}}}}])",
          square.primitive(R"(,"material":0)"))));
  const SceneDescription scene = parsed(directory / "a.gltf");
  const auto look = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [](const MaterialUse& m) { return m.params.find("anisotropy") != nullptr; });
  ASSERT_NE(look, scene.materials.end());
  const auto number = [&](const char* name) {
    return double{std::get<std::vector<float>>(look->params.find(name)->values).front()};
  };
  const double alpha = std::pow(number("roughness"), 2), aspect = std::sqrt(1 - 0.9 * number("anisotropy"));
  EXPECT_NEAR(alpha / aspect, 0.4375, 1e-5);
  EXPECT_NEAR(alpha * aspect, 0.25, 1e-5);
}

TEST(GltfScene, FilmsCoatsAndDispersion) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  put_file(directory / "a.png", "");
  put_file(
      directory / "a.gltf",
      file.text(fmt::format(
          R"("extensionsRequired":["KHR_materials_iridescence"],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],)"
          R"("textures":[{{"source":0}}],"images":[{{"uri":"a.png"}}],"materials":[{{"extensions":{{)"
          R"("KHR_materials_iridescence":{{"iridescenceFactor":0.5,"iridescenceIor":1.6,)"
          R"("iridescenceThicknessMinimum":50,"iridescenceThicknessTexture":{{"index":0}}}},)"
          R"("KHR_materials_clearcoat":{{"clearcoatFactor":1,"clearcoatNormalTexture":{{"index":0,"scale":0.7}}}},)"
          R"("KHR_materials_dispersion":{{"dispersion":1}}}}}}])",
          square.primitive(R"(,"material":0)"))));
  const gltf::Translation translation = gltf::translate(directory / "a.gltf", "a", {});
  for (const char* part :
       {"\"float iridescence\" 0.5", "\"float iridescenceeta\" 1.6", "\"texture iridescencethickness\"",
        "\"mix\" \"float tex1\" 50 \"float tex2\" 400 \"texture amount\"", "\"texture coatnormaltexture\"",
        "\"float coatnormalscale\" 0.7", "\"float abbe\" 20"})
    EXPECT_NE(translation.text.find(part), std::string::npos) << part << " in " << translation.text;
  EXPECT_TRUE(translation.notes.empty());
}

/// A file of one square with that material, and two pictures.
std::string square_of(const std::string& material) {
  GltfFile file;
  const Square square(file);
  return file.text(fmt::format(R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"textures":[{{"source":0}}],)"
                               R"("images":[{{"uri":"a.png"}}],"materials":[{{{}}}])",
                               square.primitive(R"(,"material":0)"), material));
}

// What a factor's product with something else may exceed is not cut off before the product.
TEST(GltfScene, FactorsAreBoundedAfterTheProduct) {
  TemporaryDirectory directory;
  put_file(directory / "a.png", "");
  const auto expect = [&](const std::string& material, const std::vector<std::string>& parts) {
    put_file(directory / "a.gltf", square_of(material));
    const std::string text = gltf::translate(directory / "a.gltf", "a", {}).text;
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  };
  const std::string picture = R"({"index":0})";
  const auto extension = [](const std::string& name, const std::string& members) {
    return fmt::format(R"("extensions":{{"KHR_materials_{}":{{{}}}}})", name, members);
  };
  expect(extension("specular", R"("specularColorFactor":[25,1.25,0.5])"), {"\"rgb specularcolor\" [25 1.25 0.5]"});
  expect(extension("specular", R"("specularColorFactor":[4,2,1],"specularColorTexture":)" + picture),
         {"\"float scale\" 4", "\"rgb tex2\" [1 0.5 0.25]", "\"texture specularcolor\""});
  expect(extension("specular", R"("specularColorFactor":[4,4,4],"specularColorTexture":)" + picture),
         {"\"float scale\" 4", "\"texture specularcolor\""});
  expect(extension("ior", R"("ior":0)"), {"\"rgb specularcolor\" [25 25 25]"});
  expect(R"("emissiveFactor":[3,1,0.5])", {"\"rgb emission\" [3 1 0.5]"});
  expect(R"("emissiveFactor":[3,3,3],"emissiveTexture":)" + picture, {"\"float scale\" 3", "\"texture emission\""});
  expect(extension("sheen", R"("sheenColorFactor":[2,0.5,0],"sheenRoughnessFactor":3)"),
         {"\"rgb sheen\" [1 0.5 0]", "\"float sheenroughness\" 1"});
  expect(extension("sheen", R"("sheenColorFactor":[2,0.5,0],"sheenColorTexture":)" + picture),
         {"\"float scale\" 2", "\"rgb tex2\" [1 0.25 0]"});
  expect(extension("clearcoat", R"("clearcoatFactor":1.5)"), {"\"float coat\" 1"});
  expect(extension("clearcoat", R"("clearcoatFactor":1.5,"clearcoatTexture":)" + picture),
         {"\"float scale\" 1.5", "\"texture coat\""});
  expect(extension("iridescence", R"("iridescenceFactor":1.5,"iridescenceTexture":)" + picture),
         {"\"float scale\" 1.5", "\"texture iridescence\""});
  expect(extension("anisotropy", R"("anisotropyStrength":1.5,"anisotropyTexture":)" + picture),
         {"\"float scale\" 1.5", "\"texture anisotropy\""});
  expect(extension("diffuse_transmission", R"("diffuseTransmissionFactor":1,"diffuseTransmissionColorFactor":[2,1,0],)"
                                           R"("diffuseTransmissionColorTexture":)" +
                                               picture),
         {"\"float scale\" 2", "\"rgb tex2\" [1 0.5 0]"});
  const std::string glass = R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":1},)"
                            R"("KHR_materials_volume":{"thicknessFactor":1,"attenuationColor":[1.01,0.5,0])";
  expect(glass + R"(,"attenuationDistance":2}})", {"\"rgb attenuationcolor\" [1 0.5 0]"});
  put_file(directory / "a.gltf", square_of(glass + R"(,"attenuationDistance":0}})"));
  EXPECT_EQ(gltf::translate(directory / "a.gltf", "a", {}).text.find("attenuation"), std::string::npos);
}

// sigma_t = -ln(attenuationColor) / attenuationDistance; a body of which 1 and 0.5 come back after many scatterings scatters 1 and
// 0.9117 each time: s = 0.2972, (1 - s) (1 - 0.139 s) / (1 + 1.17 s) = 0.5, 1 - s^2 = 0.9117.
TEST(GltfScene, FillsBodiesThatScatterLight) {
  TemporaryDirectory directory;
  put_file(directory / "wax.gltf",
           square_of(R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":)"
                     R"({"thicknessFactor":1,"attenuationColor":[0.5,0.5,1],"attenuationDistance":2},)"
                     R"("KHR_materials_volume_scatter":{"multiscatterColor":[1,0.5,0.5],"scatterAnisotropy":0}})"));
  const std::string text = gltf::translate(directory / "wax.gltf", "a", {}).text;
  const auto numbers = [&](const char* of) {
    std::array<float, 3> v{-1, -1, -1};
    const std::size_t at = text.find(of);
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(std::sscanf(text.c_str() + at + std::strlen(of), " [%f %f %f]", &v[0], &v[1], &v[2]), 3) << text;
    return v;
  };
  const std::array<float, 3> scattered = numbers("\"rgb sigma_s\""), absorbed = numbers("\"rgb sigma_a\"");
  const float all = std::log(2.f) / 2;
  const float expected[] = {all, 0.9117f * all, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(scattered[c], expected[c], 1e-4f);
    EXPECT_NEAR(absorbed[c], (c == 2 ? 0 : all) - expected[c], 1e-4f);
  }
  EXPECT_EQ(text.find("attenuation"), std::string::npos) << text;
  Messages messages(true);
  const LoadedScene loaded({(directory / "wax.gltf").string()}, {}, messages);
  const std::unique_ptr<Scene> scene = loaded.world->scene(loaded.job.frames);
  ASSERT_EQ(scene->media.size(), 1u);
  EXPECT_EQ(std::ranges::count_if(scene->interface_of, [](int interface) { return interface >= 0; }), 1);
}

// What the translation writes, the material takes.
TEST(GltfScene, MakesAWorldOfFactorsAboveOne) {
  TemporaryDirectory directory;
  put_file(directory / "a.gltf", square_of(R"("emissiveFactor":[3,1,0.5],"extensions":{"KHR_materials_specular":)"
                                           R"({"specularColorFactor":[25,1.25,0.5]}})"));
  Messages messages(true);
  const LoadedScene loaded({(directory / "a.gltf").string()}, {}, messages);
  EXPECT_EQ(loaded.description->frames.count(), 1);
}

/// The world of a whole file, with its meshes.
TEST(GltfScene, MakesAWorld) {
  TemporaryDirectory directory;
  put_file(directory / "chair.gltf", chair());
  Messages messages(true);
  const LoadedScene loaded({(directory / "chair.gltf").string()}, {}, messages);
  EXPECT_EQ(loaded.description->frames.count(), 50);
}

/// A square with colours of vertices as they are given, and a picture by the second texture coordinates.
template <class T>
std::string painted(const std::vector<T>& colours, int component, int width) {
  GltfFile file;
  const Square square(file);
  const int paint = file.add(colours, width == 3 ? "VEC3" : "VEC4", component, width,
                             component == 5126 ? "" : R"(,"normalized":true)");
  return file.text(fmt::format(
      R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{},"TEXCOORD_0":{},)"
      R"("TEXCOORD_1":{},"COLOR_0":{}}},"indices":{},"material":0}}]}}],"materials":[{{"alphaMode":"BLEND",)"
      R"("pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,"texCoord":1}}}}}}],"textures":[{{"source":0}}],)"
      R"("images":[{{"uri":"a.png"}}])",
      square.positions, square.uvs, square.uvs, paint, square.indices));
}

// However they are stored, half is half: in whole numbers colours are linear, too.
TEST(GltfScene, VerticesHaveColours) {
  TemporaryDirectory directory;
  put_file(directory / "a.png", "");
  const auto translated = [&](const std::string& text) {
    put_file(directory / "a.gltf", text);
    return gltf::translate(directory / "a.gltf", "a", {});
  };
  const auto check = [&](const std::string& text, bool has_opacities) {
    const gltf::Translation made = translated(text);
    EXPECT_NE(made.text.find("\"spectrum\" \"vertexcolor\""), std::string::npos) << made.text;
    EXPECT_EQ(made.text.find("\"float\" \"vertexcolor\"") != std::string::npos, has_opacities) << made.text;
    EXPECT_NE(made.text.find("\"integer uvset\" 2"), std::string::npos) << made.text;
    int meshes = 0;
    for (const auto& [name, content] : made.files) {
      if (!name.ends_with(".ply") || made.text.find("\"plymesh\" \"string filename\" \"" + name) == std::string::npos)
        continue;
      const MeshData mesh = read_ply(content());
      if (mesh.colours.empty()) continue;
      ++meshes;
      EXPECT_NEAR(mesh.colours[0][1], 0.5f, 2e-3f);
      EXPECT_EQ(mesh.second_uvs, mesh.uvs);
    }
    EXPECT_EQ(meshes, 1) << made.text;
  };
  check(painted<float>({1, .5f, 0, 1, .5f, 0, 1, .5f, 0, 1, .5f, 0}, 5126, 3), false);
  check(painted<float>({1, .5f, 0, 1, 1, .5f, 0, 1, 1, .5f, 0, 1, 1, .5f, 0, 0}, 5126, 4), true);
  check(
      painted<std::uint16_t>({65535, 32768, 0, 1, 65535, 32768, 0, 1, 65535, 32768, 0, 1, 65535, 32768, 0, 1}, 5123, 4),
      true);
  check(painted<std::uint8_t>({255, 128, 0, 1, 255, 128, 0, 1, 255, 128, 0, 1, 255, 128, 0, 1}, 5121, 4), true);
}

// However many there are, and whatever is in their names.
TEST(GltfScene, NamesTheAnimationsThatThereAre) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  std::string animations;
  for (int i = 0; i < 30; ++i)
    animations += fmt::format(R"({}{{"name":"Walk\n{}","channels":[],"samplers":[]}})", i > 0 ? "," : "",
                              i == 0 ? std::string(100'000, 'x') : std::to_string(i));
  put_file(directory / "a.gltf",
           file.text(fmt::format(R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"animations":[{}])",
                                 square.primitive(), animations)));
  gltf::Settings settings;
  settings.animation = "Run\n" + std::string(100'000, 'y');
  try {
    gltf::translate(directory / "a.gltf", "a", settings);
    ADD_FAILURE();
  } catch (const std::runtime_error& e) {
    const std::string said = e.what();
    EXPECT_EQ(said.find("it has no animation \"Run yyy"), 0u) << said;
    EXPECT_NE(said.find("available: Walk xxx"), std::string::npos) << said;
    EXPECT_NE(said.find("Walk 19 and 10 more"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_LT(said.size(), 1000u);
  }
}

TEST(GltfScene, OneOfItsCamerasLooks) {
  TemporaryDirectory directory;
  GltfFile file;
  const Square square(file);
  put_file(
      directory / "a.gltf",
      file.text(fmt::format(R"("nodes":[{{"mesh":0}},{{"name":"front","camera":0}},{{"camera":1}},{{"camera":0}}],)"
                            R"("meshes":[{{"primitives":[{}]}}],"cameras":[{{"type":"perspective","perspective":)"
                            R"({{"yfov":1,"znear":0.1}}}},{{"name":"top","type":"orthographic","orthographic":)"
                            R"({{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}}}])",
                            square.primitive())));
  const auto translated = [&](const std::string& camera) {
    gltf::Settings settings;
    settings.camera = camera;
    return gltf::translate(directory / "a.gltf", "a", settings);
  };
  const auto is_flat = [&](const std::string& camera) {
    return translated(camera).text.find("\"orthographic\"") != std::string::npos;
  };
  EXPECT_FALSE(is_flat(""));
  EXPECT_FALSE(is_flat("front"));
  EXPECT_FALSE(is_flat("3"));
  EXPECT_TRUE(is_flat("top"));
  EXPECT_TRUE(is_flat("2"));
  const std::vector<std::string> notes = translated("").notes;
  EXPECT_NE(
      std::find(notes.begin(), notes.end(), "of its cameras, front is shown; --camera chooses among front, top, 3"),
      notes.end());
  try {
    translated("side");
    ADD_FAILURE();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("it has no camera \"side\"; available: front, top, 3"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace dspm
