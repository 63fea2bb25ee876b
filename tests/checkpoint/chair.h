// A chair with two axes, rendered in small by the program with a checkpoint, and then changed.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/session/checkpoint/checkpoint_file.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/process.h"

namespace dspm::test {

struct Product {
  std::string frames = "";
  std::string first_legs = "", last_legs = "", first_seat = "", last_seat = "";  // more variations
  std::string more = "";                                                         // of the scene
  std::string oak = ".55 .38 .2", key = ".2";

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
VariationBegin "dim" Hide "cushion" Light "key" "float scale" )" +
           key + " VariationEnd\n" + last_seat + "AxisEnd\n";
  }
};

inline std::string variation(const std::string& name, const std::string& contents) {
  return fmt::format("VariationBegin \"{}\" {} VariationEnd\n", name, contents);
}
inline const std::string kBrass =
    variation("brass", R"(MakeNamedMaterial "legs" "string type" "conductor" "rgb reflectance" [.8 .6 .3])");
inline const std::string kDark = variation("dark", R"(Light "fill" "float scale" .1)");

class ChairTest : public testing::Test {
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
      for (const FileFrame frame : interval.places.going_on()) labels.back().push_back(frames.label(frame));
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
      for (int i = 0; i < iterations; ++i) made->iterate({i, *scene});
      for (std::size_t j = 0; j < together.size(); ++j, ++compared)
        EXPECT_EQ(read_image(file(frames.label(together[j]))), made->estimate(static_cast<Frame>(j)))
            << frames.label(together[j]);
    }
    EXPECT_EQ(compared, count);
  }

  TemporaryDirectory directory;
  KnownFrames known;
};

}  // namespace dspm::test
