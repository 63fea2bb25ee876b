// What directives mean: the state that is in force, and the description that comes of it.
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

Matrix4 placement(const ShapeUse& shape) { return shape.world_from_object.at(Moment()); }

TEST(Scene, KeepsTheOptionsBlock) {
  const SceneDescription scene = good(R"(
    Film "rgb" "integer xresolution" 32
    Sampler "zsobol"  PixelFilter "box"  Integrator "path"  Accelerator "bruteforce"
    Option "seed" 12  Option "Disable-Pixel_Jitter" true
    Option "disabletexturefiltering" true  Option "displacementedgescale" 2.5
    ColorSpace "srgb"
    Scale -1 1 1
    Camera "perspective" "float fov" 38
    WorldBegin)");
  EXPECT_EQ(scene.film->type, "rgb");
  EXPECT_EQ(scene.sampler->type, "zsobol");
  EXPECT_EQ(scene.filter->type, "box");
  EXPECT_EQ(scene.integrator->type, "path");
  EXPECT_EQ(scene.accelerator->type, "bruteforce");
  EXPECT_EQ(scene.options.seed, 12);
  EXPECT_TRUE(scene.options.disable_pixel_jitter);
  EXPECT_TRUE(scene.options.disable_texture_filtering);
  EXPECT_EQ(scene.options.displacement_edge_scale, 2.5f);
  EXPECT_EQ(scene.camera->type, "perspective");
  EXPECT_EQ(floats(scene.camera->params, "fov"), std::vector<float>{38});
  expect_near(scene.camera->camera_from_world.at(Moment()), Matrix4::scale(-1, 1, 1));
  EXPECT_EQ(scene.moments, 1);
}

TEST(Scene, OptionsThatDoNotChangeTheImageAreNotes) {
  const Parsed parsed = parse("Option \"wavefront\" true  Option \"disable-wavelength-jitter\" true WorldBegin");
  EXPECT_EQ(parsed.diagnostics.error_count(), 0);
  ASSERT_EQ(parsed.diagnostics.all().size(), 2u);
  for (const Diagnostic& said : parsed.diagnostics.all()) EXPECT_EQ(said.severity, Severity::note);
}

TEST(Scene, ReadsEveryTypeOfParameter) {
  const SceneDescription scene = good(R"(WorldBegin
    Shape "s" "bool b" [true false] "integer i" [1 2] "float f" [1 2] "string s" ["a" "b"] "point2 p2" [1 2]
      "vector2 v2" [1 2] "point3 p3" [1 2 3] "vector3 v3" [1 2 3] "normal n" [1 2 3] "rgb c" [1 2 3] "blackbody k" 3200
      "spectrum named" "metal-Cu-k" "spectrum pairs" [400 1 500 2] "texture t" "wood"
      "point p" [1 2 3] "vector v" [1 2 3] "normal3 n3" [1 2 3] "float none" [])");
  const ParamList& params = scene.shapes.at(0).params;
  const auto type = [&](const char* name) { return params.find(name)->type; };
  EXPECT_EQ(type("b"), ParamType::boolean);
  EXPECT_EQ(std::get<std::vector<bool>>(params.find("b")->values), (std::vector<bool>{true, false}));
  EXPECT_EQ(type("i"), ParamType::integer);
  EXPECT_EQ(std::get<std::vector<int>>(params.find("i")->values), (std::vector<int>{1, 2}));
  EXPECT_EQ(type("f"), ParamType::number);
  EXPECT_EQ(type("s"), ParamType::text);
  EXPECT_EQ(std::get<std::vector<std::string>>(params.find("s")->values), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(type("p2"), ParamType::point2);
  EXPECT_EQ(type("v2"), ParamType::vector2);
  EXPECT_EQ(type("p3"), ParamType::point3);
  EXPECT_EQ(type("v3"), ParamType::vector3);
  EXPECT_EQ(type("n"), ParamType::normal);
  EXPECT_EQ(type("c"), ParamType::rgb);
  EXPECT_EQ(type("k"), ParamType::blackbody);
  EXPECT_EQ(type("named"), ParamType::spectrum);
  EXPECT_EQ(std::get<std::vector<std::string>>(params.find("named")->values), std::vector<std::string>{"metal-Cu-k"});
  EXPECT_EQ(floats(params, "pairs"), (std::vector<float>{400, 1, 500, 2}));
  EXPECT_EQ(type("t"), ParamType::texture);
  EXPECT_EQ(type("p"), ParamType::point3);
  EXPECT_EQ(type("v"), ParamType::vector3);
  EXPECT_EQ(type("n3"), ParamType::normal);
  EXPECT_TRUE(floats(params, "none").empty());
}

TEST(Scene, LocatesParameters) {
  const SceneDescription scene = good("WorldBegin\n  Shape \"disk\"  \"float radius\" [ .15 ]");
  const Param& radius = scene.shapes.at(0).params.params.at(0);
  EXPECT_EQ(radius.where.line, 2);
  EXPECT_EQ(radius.where.column, 17);
  EXPECT_EQ(radius.where.length, 14);
  EXPECT_EQ(radius.values_where.column, 34);
  EXPECT_EQ(scene.shapes[0].where.column, 3);
  EXPECT_EQ(scene.shapes[0].type_where.column, 9);
  EXPECT_EQ(radius.where.file, scene.files[0].get());
}

TEST(Scene, AttributeBlocksRestoreEverything) {
  const SceneDescription scene = good(R"(WorldBegin
    Material "diffuse"
    Shape "a"
    AttributeBegin
      Material "conductor"
      AreaLightSource "diffuse" "string name" "key" "rgb L" [1 1 1]
      ReverseOrientation
      Translate 1 2 3
      Shape "b"
      TransformBegin NamedMaterial "wood" Scale 2 2 2 Shape "c" TransformEnd
    AttributeEnd
    Shape "d")");
  ASSERT_EQ(scene.shapes.size(), 4u);
  EXPECT_EQ(scene.materials.at(0).type, "diffuse");
  EXPECT_EQ(scene.materials.at(1).type, "conductor");
  EXPECT_EQ(scene.shapes[0].material.index, 0);
  EXPECT_EQ(scene.shapes[1].material.index, 1);
  EXPECT_EQ(scene.shapes[2].material.index, -1);
  EXPECT_EQ(scene.shapes[2].material.name, "wood");
  EXPECT_EQ(scene.shapes[3].material.index, 0);
  EXPECT_EQ(scene.shapes[0].area_light, -1);
  EXPECT_EQ(scene.shapes[1].area_light, 0);
  EXPECT_EQ(scene.shapes[3].area_light, -1);
  EXPECT_EQ(scene.area_lights.at(0).name, "key");
  EXPECT_EQ(scene.area_lights[0].params.find("name"), nullptr);
  EXPECT_FALSE(scene.shapes[0].reverse_orientation);
  EXPECT_TRUE(scene.shapes[1].reverse_orientation);
  EXPECT_FALSE(scene.shapes[3].reverse_orientation);
  expect_near(placement(scene.shapes[1]), Matrix4::translate(1, 2, 3));
  expect_near(placement(scene.shapes[2]), Matrix4::translate(1, 2, 3) * Matrix4::scale(2, 2, 2));
  expect_near(placement(scene.shapes[3]), Matrix4{});
}

TEST(Scene, MultipliesTransformsFromTheRight) {
  const SceneDescription scene = good(R"(WorldBegin
    Translate 1 0 0  Rotate 90 0 0 1  Scale 2 3 4
    ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]
    Shape "a"
    Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]  Shape "b"
    Identity  LookAt 0 0 -5  0 0 0  0 1 0  Shape "c")");
  expect_near(placement(scene.shapes[0]), Matrix4::translate(1, 0, 0) * Matrix4::rotate(90, 0, 0, 1) *
                                              Matrix4::scale(2, 3, 4) * Matrix4::translate(5, 6, 7));
  expect_near(placement(scene.shapes[1]), Matrix4::translate(5, 6, 7));
  expect_near(placement(scene.shapes[2]), Matrix4::translate(0, 0, 5));
}

TEST(Scene, RemembersCoordinateSystems) {
  const SceneDescription scene = good(R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective"
    Translate 9 9 9
    WorldBegin
    Shape "world"
    Translate 1 2 3  CoordinateSystem "here"
    CoordSysTransform "camera"  Shape "camera"
    CoordSysTransform "here"    Shape "here"
    CoordSysTransform "world"   Shape "world")");
  expect_near(placement(scene.shapes[0]), Matrix4{});
  expect_near(placement(scene.shapes[1]), Matrix4::translate(0, 0, -5));
  expect_near(placement(scene.shapes[2]), Matrix4::translate(1, 2, 3));
  expect_near(placement(scene.shapes[3]), Matrix4{});
}

TEST(Scene, AttributeGivesDefaults) {
  const SceneDescription scene = good(R"(WorldBegin
    AttributeBegin
      Attribute "shape" "float radius" 2 "float zmin" 0
      Attribute "shape" "float radius" 3
      Attribute "material" "rgb reflectance" [1 0 0]
      Material "diffuse"
      Shape "sphere"
      Shape "sphere" "float radius" 4
    AttributeEnd
    Shape "sphere")");
  EXPECT_EQ(floats(scene.shapes[0].params, "radius"), std::vector<float>{3});
  EXPECT_TRUE(scene.shapes[0].params.find("radius")->is_default);
  EXPECT_EQ(floats(scene.shapes[0].params, "zmin"), std::vector<float>{0});
  EXPECT_EQ(floats(scene.shapes[1].params, "radius"), std::vector<float>{4});
  EXPECT_FALSE(scene.shapes[1].params.find("radius")->is_default);
  EXPECT_EQ(scene.shapes[1].params.params.size(), 2u);
  EXPECT_TRUE(scene.shapes[2].params.params.empty());
  EXPECT_EQ(floats(scene.materials[0].params, "reflectance"), (std::vector<float>{1, 0, 0}));
}

TEST(Scene, NamesMaterialsTexturesAndLights) {
  const SceneDescription scene = good(R"(WorldBegin
    MakeNamedMaterial "wood" "rgb reflectance" [.5 .3 .1] "string type" "diffuse"
    Scale 2 2 2
    Texture "grain" "float" "imagemap" "string filename" "a.png"
    Texture "grain" "spectrum" "constant"
    LightSource "point" "string name" "key" "float scale" 2)");
  EXPECT_EQ(scene.materials.at(0).name, "wood");
  EXPECT_EQ(scene.materials[0].type, "diffuse");
  EXPECT_EQ(scene.materials[0].params.params.size(), 1u);
  EXPECT_EQ(scene.materials[0].type_where.column, 73);
  EXPECT_EQ(scene.textures.at(0).name, "grain");
  EXPECT_EQ(scene.textures[0].type, "imagemap");
  EXPECT_FALSE(scene.textures[0].is_spectrum);
  expect_near(scene.textures[0].world_from_texture.at(Moment()), Matrix4::scale(2, 2, 2));
  EXPECT_TRUE(scene.textures.at(1).is_spectrum);
  EXPECT_EQ(scene.lights.at(0).name, "key");
  EXPECT_EQ(scene.lights[0].params.params.size(), 1u);
  expect_near(scene.lights[0].world_from_light.at(Moment()), Matrix4::scale(2, 2, 2));
}

TEST(Scene, KeepsObjectsApart) {
  const SceneDescription scene = good(R"(WorldBegin
    Translate 1 0 0
    ObjectBegin "leg"
      Scale 2 2 2
      Shape "cylinder"
      AttributeBegin Shape "disk" AttributeEnd
    ObjectEnd
    Shape "sphere"
    Rotate 30 0 1 0
    ObjectInstance "leg")");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "leg");
  ASSERT_EQ(scene.objects[0].shapes.size(), 2u);
  expect_near(placement(scene.objects[0].shapes[0]), Matrix4::translate(1, 0, 0) * Matrix4::scale(2, 2, 2));
  ASSERT_EQ(scene.shapes.size(), 1u);
  expect_near(placement(scene.shapes[0]), Matrix4::translate(1, 0, 0));
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "leg");
  expect_near(scene.instances[0].world_from_instance.at(Moment()),
              Matrix4::translate(1, 0, 0) * Matrix4::rotate(30, 0, 1, 0));
}

TEST(Scene, KeepsMedia) {
  const SceneDescription scene = good(R"(
    MediumInterface "" "fog"
    MakeNamedMedium "fog" "string type" "homogeneous" "float g" .3
    WorldBegin
    MediumInterface "milk")");
  EXPECT_EQ(scene.media.at(0).name, "fog");
  EXPECT_EQ(scene.media[0].type, "homogeneous");
  EXPECT_EQ(scene.medium_interfaces.at(0).inside, "");
  EXPECT_EQ(scene.medium_interfaces[0].outside, "fog");
  EXPECT_EQ(scene.medium_interfaces.at(1).inside, "milk");
  EXPECT_EQ(scene.medium_interfaces[1].outside, "milk");
}

TEST(Scene, KnowsItsDialect) {
  Diagnostics diagnostics;
  const auto dialect = [&](const char* name) { return parse_text(name, "WorldBegin", {}, diagnostics).dialect; };
  EXPECT_EQ(dialect("a.pbrt"), Dialect::pbrt);
  EXPECT_EQ(dialect("a.pbrt.gz"), Dialect::pbrt);
  EXPECT_EQ(dialect("a.dsc"), Dialect::dsc);
  EXPECT_EQ(dialect("-"), Dialect::dsc);
}

TEST(Scene, SaysWhenTheSecondReplacesTheFirst) {
  const Parsed parsed = parse("Film \"rgb\"\nFilm \"spectral\"\nWorldBegin");
  EXPECT_EQ(parsed.scene.film->type, "spectral");
  EXPECT_EQ(parsed.messages(),
            "scene.dsc:2:1: warning: this Film replaces the one on line 1\n    2 | Film \"spectral\"\n      | ^~~~\n");
}

TEST(Scene, ActiveTransformMovesWhatFollows) {
  const Parsed parsed = parse(R"(TransformTimes 2 4
    ActiveTransform EndTime LookAt 1 0 0  1 0 1  0 1 0  ActiveTransform All
    Camera "perspective"
    WorldBegin
    ActiveTransform StartTime  Translate 1 0 0
    ActiveTransform EndTime    Translate 5 0 0
    ActiveTransform All        Translate 0 2 0
    Shape "sphere")",
                              {}, "scene.pbrt");
  EXPECT_EQ(parsed.messages(), "");
  const Motion& moving = parsed.scene.shapes.at(0).world_from_object;
  expect_near(moving.at(Moment(1)), Matrix4::translate(1, 2, 0));
  expect_near(moving.at(Moment(2)), Matrix4::translate(1, 2, 0));
  expect_near(moving.at(Moment(3)), Matrix4::translate(3, 2, 0));
  expect_near(moving.at(Moment(5)), Matrix4::translate(5, 2, 0));
  expect_near(parsed.scene.camera->camera_from_world.at(Moment(3)), Matrix4::translate(-0.5, 0, 0));
}

TEST(Scene, ActiveTransformWithoutDifferenceMovesNothing) {
  const SceneDescription scene =
      good("WorldBegin ActiveTransform EndTime ActiveTransform All Translate 1 0 0 Shape \"sphere\"");
  EXPECT_FALSE(scene.shapes.at(0).world_from_object.is_keyed());
}

}  // namespace
}  // namespace dspm::test
