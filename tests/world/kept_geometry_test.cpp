// What is kept of a scene's geometry for the next one: nothing that changed, and all that did not.
#include "dspm/world/objects/kept_geometry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "dspm/accel/two_level.h"
#include "dspm/base/math/moments.h"
#include "dspm/lang/parse.h"
#include "dspm/world/world.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace kept_geometry_test {

struct Loaded {
  Loaded(const TemporaryDirectory& folder, const std::string& shapes, KeptGeometry* kept)
      : description(parse_text((folder / "scene.dsc").string(), text_of(shapes), {}, diagnostics)),
        world(description, {.kept = kept}, diagnostics) {
    diagnostics.throw_if_errors();
    const std::vector<FileFrame> frames{FileFrame(0), FileFrame(1)};
    scene = world.scene(frames);
    if (kept != nullptr) kept->scene_is_loaded();
  }
  static std::string text_of(const std::string& shapes) {
    return "Frames 2 WorldBegin LightSource \"infinite\" Material \"dielectric\" " + shapes;
  }
  const Shape* shape(std::size_t i) const { return scene->shapes[i].shape; }

  Diagnostics diagnostics;
  SceneDescription description;
  World world;
  std::unique_ptr<Scene> scene;
};

std::string ply(const std::string& apex) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
         apex + "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
}

/// As what is known of a file's content by its time is not trusted before.
void let_files_age() { std::this_thread::sleep_for(std::chrono::milliseconds(2100)); }

/// Rays to everywhere meet the same in both.
void expect_same_hits(const Scene& a, const Scene& b) {
  for (int i = 0; i < 500; ++i) {
    const auto at = [&](int k) { return static_cast<float>((i * k) % 101) / 50 - 1; };
    const Ray ray{{0.2f, 0.3f, -4}, {at(17) / 2, at(29) / 2, 1}, kInfinity};
    const HitPartition of_a = a.accel->partition(ray, a.frames()), of_b = b.accel->partition(ray, b.frames());
    ASSERT_EQ(of_a.size(), of_b.size());
    for (int part = 0; part < of_a.size(); ++part) {
      EXPECT_EQ(of_a[part].frames, of_b[part].frames);
      EXPECT_EQ(of_a[part].hit.t, of_b[part].hit.t);
      EXPECT_EQ(of_a[part].hit.shape, of_b[part].hit.shape);
    }
  }
}

class Kept : public testing::Test {
 protected:
  Loaded load(const std::string& shapes) { return {folder, shapes, &kept}; }

  TemporaryDirectory folder;
  KeptGeometry kept;
};

TEST_F(Kept, WhatDoesNotChangeIsTheSameObject) {
  const std::string ball = "Shape \"sphere\" \"float radius\" 1 ", other = "Shape \"sphere\" \"float radius\" 2 ";
  const std::string moved =
      "AttributeBegin Translate 1 2 3 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] "
      "\"bool open\" true AttributeEnd ";
  const Loaded first = load(ball + moved), second = load("Material \"diffuse\" " + ball + moved + other);
  EXPECT_EQ(first.shape(0), second.shape(0));
  EXPECT_EQ(first.shape(1), second.shape(1)) << "in world space, too";
  EXPECT_NE(second.shape(0), second.shape(2));
  const Loaded third = load("AttributeBegin Translate 0 0 1e-3 " + moved + "AttributeEnd");
  EXPECT_NE(third.shape(0), first.shape(1));
}

TEST_F(Kept, HairThatIsLongerByAStrandIsMadeAsIfNothingWereKept) {
  const auto strand = [](int x) {
    return fmt::format("Shape \"curve\" \"point3 P\" [{0} 0 0 {0} 1 0 {0} 2 1 {0} 3 1] \"float width\" .1 ", x);
  };
  const Loaded one = load(strand(0)), two = load(strand(0) + strand(1));
  const Loaded alone(folder, strand(0) + strand(1), nullptr), again = load(strand(0) + strand(1));
  ASSERT_EQ(two.scene->shapes.size(), alone.scene->shapes.size());
  EXPECT_EQ(two.shape(0)->primitive_count(), alone.shape(0)->primitive_count());
  EXPECT_EQ(one.shape(0)->primitive_count() * 2, two.shape(0)->primitive_count());
  EXPECT_EQ(again.shape(0), two.shape(0));
  expect_same_hits(*again.scene, *alone.scene);
}

TEST_F(Kept, AFileThatIsSavedIsReadAgain) {
  put_file(folder / "a.ply", ply("0 0 1"));
  let_files_age();
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"a.ply\" ";
  const Loaded first = load(mesh), same = load("Material \"diffuse\" " + mesh);
  EXPECT_EQ(first.shape(0), same.shape(0));
  put_file(folder / "a.ply", ply("0 0 2"));  // of the same size
  const Loaded changed = load(mesh), alone(folder, mesh, nullptr);
  EXPECT_NE(changed.shape(0), first.shape(0));
  EXPECT_EQ(changed.shape(0)->bounds(1).high.z, alone.shape(0)->bounds(1).high.z);
  expect_same_hits(*changed.scene, *alone.scene);
}

TEST_F(Kept, AFileThatIsJustSavedIsNotTrusted) {
  put_file(folder / "a.ply", ply("0 0 1"));
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"a.ply\" ";
  EXPECT_NE(load(mesh).shape(0), nullptr);
  put_file(folder / "a.ply", ply("0 0 3"));
  EXPECT_EQ(load(mesh).shape(0)->bounds(1).high.z, 3);
}

TEST_F(Kept, WarningsAreSaidAgain) {
  const std::string hole =
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  0 0 1] "
      "\"integer indices\" [0 1 2  0 3 1] ";
  const Loaded first = load(hole), second = load(hole);
  EXPECT_EQ(first.diagnostics.all().size(), 1u);
  EXPECT_EQ(second.diagnostics.all().size(), 1u);
}

TEST_F(Kept, ATreeIsThatOfTheSameShapesAtTheSamePlaces) {
  const auto ball = [](float x) {
    return fmt::format(
        "DynamicBegin \"ball\" Keyframe 1 Translate {} 0 0 Keyframe 2 Translate 1 0 0 KeyframeEnd "
        "Shape \"sphere\" DynamicEnd Shape \"disk\" \"float radius\" 3 ",
        x);
  };
  // Of what is known, some trees have all shapes, others only those that are static.
  for (const float x : {0.f, 0.f, 1e-3f, 0.f, .5f}) {
    const Loaded with = load(ball(x)), without(folder, ball(x), nullptr);
    expect_same_hits(*with.scene, *without.scene);
  }
}

TEST_F(Kept, WhatStaysWhileTheShutterIsOpenHasOneTree) {
  const std::string text =
      "DynamicBegin \"ball\" Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 1 0 0 KeyframeEnd "
      "Shape \"sphere\" DynamicEnd Shape \"disk\" \"float radius\" 3 Shape \"sphere\" \"float radius\" .2 ";
  Diagnostics diagnostics;
  const SceneDescription description = parse_text("scene.dsc", Loaded::text_of(text), {}, diagnostics);
  const World world(description, {.kept = &kept, .blurs = true}, diagnostics);
  const std::vector<FileFrame> frames{FileFrame(0), FileFrame(1)};
  const auto scene = world.scene(frames);
  const auto tree_of = [](const Scene& of) { return &dynamic_cast<const TwoLevel&>(*of.accel).static_tree(); };
  std::vector<const Tree*> trees;
  for (const double delay : {0.25, 0.5}) {
    const auto later = world.after(delay), alone = world.after(delay);
    const auto sharing = later->scene(frames, scene.get()), anew = alone->scene(frames);
    ASSERT_EQ(sharing->shapes.size(), scene->shapes.size());
    EXPECT_NE(tree_of(*sharing), tree_of(*anew));
    expect_same_hits(*sharing, *anew);
    trees.push_back(tree_of(*sharing));
  }
  EXPECT_EQ(trees[0], trees[1]);
}

}  // namespace kept_geometry_test
}  // namespace dspm::test
