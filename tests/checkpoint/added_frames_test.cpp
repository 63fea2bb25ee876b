// Resuming with frames that were added, or chosen, since: those that were there keep their state, and every image is,
// bit by bit, that of a run of all frames with what the checkpoint's first frames decide.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/checkpoint/checkpoint_file.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/choices.h"
#include "dspm/world/job.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

struct Product {
  std::string frames = "";
  std::string first_legs = "", last_legs = "", first_seat = "", last_seat = "";  // more variations
  std::string more = "";                                                         // of the scene
  std::string oak = ".55 .38 .2";

  std::string text() const {
    return frames + R"(
LookAt 0 .5 -4  0 .3 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "string filename" "chair.exr" "bool savefp16" false
Integrator "dsppm" "integer iterations" 3 "integer photons" 500 "integer maxdepth" 5
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 8 7] "string name" "key"
  Translate 0 2.5 -1
  Shape "sphere" "float radius" .4
AttributeEnd
LightSource "point" "rgb I" [3 3 3] "point3 from" [-2 1 -1] "string name" "fill"
MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [.5 .4 .3]
MakeNamedMaterial "seat" "string type" "diffuse" "rgb reflectance" [.3 .4 .5]
Material "diffuse" "rgb reflectance" [.6 .6 .6]
AttributeBegin Translate 0 0 8 Shape "sphere" "float radius" 29 AttributeEnd
NamedMaterial "legs"
AttributeBegin Translate -.6 .1 0 Shape "sphere" "float radius" .5 AttributeEnd
NamedMaterial "seat"
AttributeBegin Translate .6 .1 0 Shape "sphere" "float radius" .5 AttributeEnd
DynamicBegin "cushion" Translate 0 .9 0 Shape "sphere" "float radius" .3 DynamicEnd
)" + more + "\nAxisBegin \"legs\"\n" +
           first_legs + R"(VariationBegin "oak" MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [)" +
           oak + R"(] VariationEnd
VariationBegin "steel" MakeNamedMaterial "legs" "string type" "conductor" "float roughness" .15 VariationEnd
)" + last_legs +
           "AxisEnd\nAxisBegin \"seat\"\n" + first_seat + R"(VariationBegin "plain" VariationEnd
VariationBegin "dim" Hide "cushion" Light "key" "float scale" .2 VariationEnd
)" + last_seat +
           "AxisEnd\n";
  }
};

std::string variation(const std::string& name, const std::string& contents) {
  return fmt::format("VariationBegin \"{}\" {} VariationEnd\n", name, contents);
}
const std::string kBrass =
    variation("brass", R"(MakeNamedMaterial "legs" "string type" "conductor" "rgb reflectance" [.8 .6 .3])");
const std::string kDark = variation("dark", R"(Light "fill" "float scale" .1)");

class AddedFrames : public testing::Test {
 protected:
  void put(const std::string& text) { put_file(directory / "chair.dsc", text); }
  Outcome dspm(const Arguments& arguments) { return run(directory, Arguments{"chair.dsc"} + arguments); }
  Outcome good(const Arguments& arguments) {
    Outcome outcome = dspm(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  void begin(const Product& product, const Arguments& arguments = {}) {
    put(product.text());
    good(Arguments{"--checkpoint", "a"} + arguments);
    known = CheckpointFile(directory / "a").render().frames;
  }
  std::filesystem::path file(const std::string& label) const {
    const std::size_t space = label.find(' ');
    const std::string number = space == label.npos ? "" : fmt::format(".{:04}", std::stoi(label.substr(space)));
    return directory / fmt::format("chair.{}{}.exr", label.substr(0, space), number);
  }
  int iterations(const std::string& label) const { return read_exr_header(file(label)).integers.at("iterations"); }

  /// The frames' labels, interval by interval.
  std::vector<std::vector<std::string>> intervals() const {
    const CheckpointFile checkpoint(directory / "a");
    const FileFrames frames(checkpoint.render().frames);
    std::vector<std::vector<std::string>> labels;
    for (const IntervalState& interval : checkpoint.intervals()) {
      labels.emplace_back();
      for (const FileFrame frame : interval.frames) labels.back().push_back(frames.label(frame));
    }
    return labels;
  }

  /// The files against a run of all frames, in the same intervals, that knows what the checkpoint's first frames were.
  void expect_all(const std::string& text, int iterations, std::size_t count) {
    Choices choices;
    choices.known = known;
    TestScene reference(text, choices);
    const FileFrames& frames = reference.job().description->frames;
    std::size_t compared = 0;
    for (const std::vector<std::string>& interval : intervals()) {
      std::vector<FileFrame> together;
      for (FileFrame f(0); f.index() < frames.count(); ++f)
        if (std::find(interval.begin(), interval.end(), frames.label(f)) != interval.end()) together.push_back(f);
      const std::unique_ptr<Scene> scene = reference.scene(together);
      const std::unique_ptr<Integrator> made = reference.integrator(*scene);
      for (int i = 0; i < iterations; ++i) made->iterate(i, *scene);
      for (std::size_t j = 0; j < together.size(); ++j, ++compared)
        EXPECT_EQ(read_image(file(frames.label(together[j]))), made->estimate(static_cast<Frame>(j)))
            << frames.label(together[j]);
    }
    EXPECT_EQ(compared, count);
  }

  TemporaryDirectory directory;
  KnownFrames known;
};

TEST_F(AddedFrames, AreThoseOfARunOfAll) {
  Product product;
  begin(product);
  product.first_seat = kDark, product.last_legs = kBrass;  // among the others, and after them
  put(product.text());
  const Outcome outcome = good({"--resume", "a", "--iterations", "5"});
  EXPECT_NE(outcome.err.find("5 frames added to the checkpoint's"), std::string::npos) << outcome.err;
  expect_all(product.text(), 5, 9);
  // A file with all from the start chooses lights otherwise.
  TestScene anew(product.text());
  EXPECT_NE(read_image(file("oak-plain")), anew.render(FileFrame(1), 5));

  // Once more, at the end of a run that had added some.
  product.first_legs = variation("white", R"(MakeNamedMaterial "legs" "string type" "diffuse")");
  put(product.text());
  good({"--resume", "a", "--iterations", "6", "--memory", "1G"});
  expect_all(product.text(), 6, 12);
}

TEST_F(AddedFrames, OnlyNewOnesGoAsFarAsTheOthers) {
  Product product;
  begin(product);
  product.last_legs = kBrass;
  put(product.text());
  for (const char* old : {"oak-plain", "oak-dim", "steel-plain", "steel-dim"}) std::filesystem::remove(file(old));
  good({"--resume", "a", "--only-new"});
  EXPECT_FALSE(std::filesystem::exists(file("oak-plain")));
  EXPECT_EQ(iterations("brass-plain"), 3);
  EXPECT_EQ(iterations("brass-dim"), 3);
  EXPECT_EQ(dspm({"--resume", "a", "--only-new"}).err,
            "dspm: --only-new: the checkpoint holds all chosen frames already\n");
  good({"--resume", "a", "--iterations", "4"});
  expect_all(product.text(), 4, 6);
}

TEST_F(AddedFrames, MayHaveBeenLeftOutBefore) {
  const Product product;
  begin(product, {"--variation", "oak-*"});
  good({"--resume", "a", "--variation", "steel-dim"});
  EXPECT_FALSE(std::filesystem::exists(file("steel-plain")));
  good({"--resume", "a"});
  expect_all(product.text(), 3, 4);
}

TEST_F(AddedFrames, MakeAnimationsLonger) {
  Product product;
  product.frames = "Frames 2";
  product.more =
      R"(DynamicBegin "ball" Keyframe 1 Translate 0 0 -1 Keyframe 2 Translate 0 1 -1 Keyframe 3 Translate 0 .5 -1
KeyframeEnd Shape "sphere" "float radius" .2 DynamicEnd)";
  begin(product, {"--frames", "1"});
  product.frames = "Frames 3";
  put(product.text());
  good({"--resume", "a"});
  expect_all(product.text(), 3, 12);
}

TEST_F(AddedFrames, MayHaveNewShapes) {
  Product product;
  begin(product);
  product.more =
      R"(DynamicBegin "bell" Material "conductor" Translate 0 .9 0 Shape "sphere" "float radius" .2 DynamicEnd)";
  product.last_seat = variation("bell", R"(Show "bell" Hide "cushion")");
  put(product.text());
  good({"--resume", "a"});
  expect_all(product.text(), 3, 6);
}

struct Refused {
  Product product;
  std::string told;
};

TEST_F(AddedFrames, ThatWouldBeWrongAreRefusedByName) {
  begin({}, {"--iterations", "1"});
  const std::string before = contents(directory / "a");
  const auto with = [](auto&& change) {
    Product product;
    change(product);
    return product;
  };
  const std::string lamp =
      R"(AttributeBegin AreaLightSource "diffuse" DynamicBegin "lamp" Translate 0 1 0 Shape "sphere" "float radius" .1
DynamicEnd AttributeEnd)";
  const std::string far = R"(DynamicBegin "far" Translate 0 0 90 Shape "sphere" DynamicEnd)";
  const std::vector<Refused> all = {
      {with([&](Product& p) { p.more = lamp, p.last_seat = variation("lit", "Show \"lamp\""); }),
       "error: oak-lit, steel-lit: the light \"lamp\" shone in no frame that the checkpoint was begun with\n"},
      {with([&](Product& p) { p.more = far, p.last_seat = variation("wide", "Show \"far\""); }),
       "error: oak-wide, steel-wide: some of it lies outside of what the checkpoint was begun with\n"},
      {with([&](Product& p) { p.last_seat = variation("soft", "Show \"cushion\""), p.oak = ".5 .5 .5"; }),
       "material \"legs\" of variation \"oak\" has changed since the checkpoint"},
      {with([&](Product& p) { p.last_seat = variation("soft", "Show \"cushion\""); }),
       "dynamic \"cushion\" has changed since the checkpoint"},
      {with([&](Product& p) { p.more = "Shape \"sphere\""; }), "shape \"sphere\" is new since the checkpoint"},
      {with([&](Product& p) { p.more = "AxisExclude \"steel\""; }),
       "variation steel-plain of the checkpoint is not there any more"},
  };
  for (const Refused& each : all) {
    put(each.product.text());
    const Outcome outcome = dspm({"--resume", "a"});
    EXPECT_EQ(outcome.code, 1) << each.told;
    EXPECT_NE(outcome.err.find(each.told), std::string::npos) << each.told << "\n" << outcome.err;
    EXPECT_EQ(contents(directory / "a"), before);
  }
}

}  // namespace
}  // namespace dspm::test
