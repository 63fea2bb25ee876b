// Files that include a scene and change it: defaults of $names, and another Camera, Film or Integrator.
#include <fmt/format.h>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/read_file.h"
#include "tests/lang/parsing.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

class Wrapper : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) { put_file(directory / name, text); }

  /// The messages, without the directory's name.
  std::string parse(const std::vector<std::string>& names, const Defines& defines = {}) {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((directory / name).string());
    Diagnostics diagnostics;
    scene = parse_files(paths, {defines}, diagnostics);
    std::string messages;
    for (const Diagnostic& each : diagnostics.all())
      messages += (each.where.file ? std::filesystem::path(each.where.file->name).filename().string() : "") +
                  fmt::format(":{}:{} {} | {}\n", each.where.line, each.where.column, each.message, each.hint);
    const std::string prefix = (directory / "").string();
    for (std::size_t at; (at = messages.find(prefix)) != messages.npos;) messages.erase(at, prefix.size());
    return messages;
  }

  TemporaryDirectory directory;
  SceneDescription scene;
};

TEST_F(Wrapper, ADefaultHoldsFromThereOnUnlessAValueWasGiven) {
  put("main.dsc", "Default fov 40\nCamera \"a\" \"float fov\" $fov\nWorldBegin\nDefault kind \"a b\" Shape \"$kind\"");
  EXPECT_EQ(parse({"main.dsc"}), "");
  EXPECT_EQ(floats(scene.camera->params, "fov"), std::vector<float>{40});
  EXPECT_EQ(scene.camera->params.params[0].values_where.line, 2);
  EXPECT_EQ(scene.camera->params.params[0].values_where.column, 24);
  EXPECT_EQ(scene.shapes.at(0).type, "a b");
  EXPECT_EQ(parse({"main.dsc"}, {{"fov", "25"}}), "");
  EXPECT_EQ(floats(scene.camera->params, "fov"), std::vector<float>{25});
}

TEST_F(Wrapper, TheIncludingFilesDefaultGoesFirstAndAnIncludedOneHoldsAfterwards) {
  put("scene.dsc", "Default size 1 Default colour \"1 2 3\" WorldBegin Shape \"a\" \"float s\" $size");
  put("main.dsc", "Default size 7 # $none \"\nInclude \"scene.dsc\"\nShape \"b\" \"float c\" [$colour]");
  EXPECT_EQ(parse({"main.dsc"}), "");
  EXPECT_EQ(floats(scene.shapes.at(0).params, "s"), std::vector<float>{7});
  EXPECT_EQ(floats(scene.shapes.at(1).params, "c"), (std::vector<float>{1, 2, 3}));
}

TEST_F(Wrapper, WrongDefaults) {
  put("main.dsc", "WorldBegin\nTranslate 0 0 $x\nDefault x 1\nDefault a-b 1\nDefault y Camera");
  EXPECT_EQ(parse({"main.dsc"}),
            "main.dsc:2:15 $x has no value | give it one: Default x 1 before it, or -D x=1 on the command line\n"
            "main.dsc:4:9 \"a-b\" cannot be the name of a value | names consist of letters, digits and _\n"
            "main.dsc:5:1 Default y has no value | Default y 1\n");
}

constexpr const char* kWrappedScene =
    "LookAt 0 0 -9 0 0 0 0 1 0\nCamera \"a\"\nFilm \"rgb\"\nIntegrator \"path\"\nWorldBegin\nTranslate 1 0 0\nShape "
    "\"s\"\n";

TEST_F(Wrapper, ALaterJobOfTheIncludingFileReplacesTheScenes) {
  put("scene.dsc", kWrappedScene);
  put("main.dsc",
      "Include \"scene.dsc\"\nTranslate 0 0 5\nCamera \"b\"\nFilm \"gbuffer\"\nIntegrator \"dsppm\"\nShape \"after\"");
  EXPECT_EQ(parse({"main.dsc"}), "");
  EXPECT_EQ(scene.camera->type, "b");
  expect_near(scene.camera->camera_from_world.at(Moment()), Matrix4::translate(0, 0, 5));
  EXPECT_EQ(scene.film->type, "gbuffer");
  EXPECT_EQ(scene.integrator->type, "dsppm");
  expect_near(scene.shapes.at(1).world_from_object.at(Moment()), Matrix4());
}

TEST_F(Wrapper, ACameraWithoutATransformStaysWhereTheScenesStands) {
  put("scene.dsc", kWrappedScene);
  put("main.dsc",
      "Include \"scene.dsc\"\nCamera \"b\"\nVariationBegin \"v\" Camera \"c\" VariationEnd\n"
      "VariationBegin \"w\" Translate 0 0 5 Camera \"c\" Translate 1 0 0 VariationEnd");
  EXPECT_EQ(parse({"main.dsc"}), "");
  EXPECT_EQ(scene.camera->type, "b");
  const Matrix4 place = scene.camera->camera_from_world.at(Moment());
  EXPECT_NEAR(Transform(place).point({}).z, 9, 1e-5f);
  expect_near(scene.axes.at(0).variations.at(0).camera->camera_from_world.at(Moment()), place);
  expect_near(scene.axes.at(0).variations.at(1).camera->camera_from_world.at(Moment()), Matrix4::translate(0, 0, 5));
}

TEST_F(Wrapper, ItsCameraMayMove) {
  put("scene.dsc", std::string("Frames 9\nKeyframe 1 Translate 1 0 0 KeyframeEnd\n") + kWrappedScene);
  put("main.dsc",
      "Include \"scene.dsc\"\nKeyframe 1 Translate 0 0 0\nKeyframe 9 Translate 0 0 8\nKeyframeEnd\nCamera \"b\"\n");
  EXPECT_EQ(parse({"main.dsc"}), "");
  expect_near(scene.camera->camera_from_world.at(Moment::numbered(5)), Matrix4::translate(0, 0, 4));
  put("main.dsc", "Include \"scene.dsc\"\nKeyframe 1 Translate 0 0 0 KeyframeEnd\nShape \"s\"");
  EXPECT_EQ(parse({"main.dsc"}),
            "main.dsc:3:1 this Shape moves, but is not in a Dynamic block | put it and its keys between DynamicBegin "
            "\"a name\" and DynamicEnd\n");
}

TEST_F(Wrapper, WhatIsReplacedUnawaresNamesBothFiles) {
  put("scene.dsc", kWrappedScene);
  put("main.dsc", "Film \"rgb\"\nInclude \"scene.dsc\"\nCamera \"b\"\nCamera \"c\"");
  EXPECT_EQ(parse({"main.dsc"}),
            "scene.dsc:3:1 this Film replaces the one on main.dsc:1 | \n"
            "main.dsc:4:1 this Camera replaces the one on line 3 | \n");
}

TEST_F(Wrapper, OnlyTheIncludingFileMay) {
  put("scene.dsc", std::string(kWrappedScene) + "Film \"rgb\"\nInclude \"part.dsc\"");
  put("part.dsc", "Camera \"b\"");
  put("main.dsc", "Include \"scene.dsc\"\nAttributeBegin Camera \"b\" AttributeEnd\nWorldBegin");
  EXPECT_EQ(parse({"main.dsc"}),
            "scene.dsc:8:1 Film must come before WorldBegin | the world begins on line 5\n"
            "part.dsc:1:1 Camera must come before WorldBegin | the world begins on scene.dsc:5\n"
            "main.dsc:2:16 Camera must come before WorldBegin | the world begins on scene.dsc:5\n"
            "main.dsc:3:1 a second WorldBegin | the first is on scene.dsc:5\n");
}

}  // namespace
}  // namespace dspm::test
