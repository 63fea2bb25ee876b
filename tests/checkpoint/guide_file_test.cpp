// A guide goes through a file to other runs of its scene, and to no other scene.
#include "dspm/session/checkpoint/guide_file.h"

#include <gtest/gtest.h>

#include "dspm/base/system/read_file.h"
#include "dspm/image/image.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/stage.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace guide_file_test {

constexpr const char* kIntegrator = R"("dsppm" "string direct" "photons" "integer photons" 20000)";
constexpr const char* kLamp = "LightSource \"point\" \"rgb I\" [5 5 5] \"point3 from\" [0 0 1]";

/// A sun and a lamp over a wide floor of which little is seen.
std::string scene(const std::string& integrator = kIntegrator, const std::string& lamp = kLamp) {
  return "Integrator " + integrator + R"(
LookAt 0 0 2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "distant" "rgb L" [2 2 2]
)" + lamp +
         R"(
Shape "disk" "float radius" 50
)";
}

/// A run that learns, or is given a guide.
struct Trial {
  Diagnostics diagnostics;
  Messages messages{true};
  LoadedScene loaded;

  explicit Trial(const std::string& text, const std::filesystem::path& guide = {}, const Choices& choices = {})
      : loaded("test.dsc", text, choices, diagnostics) {
    loaded.job.settings.learn_at_once = true;
    if (!guide.empty()) load_guide(guide, loaded.job);
  }
  Image render() {
    Stage stage(loaded, loaded.job.frames);
    stage.make_integrator(messages);
    stage.iterate(0);
    return stage.integrator().estimate(0);
  }
};

class GuideFile : public testing::Test {
 protected:
  GuideFile() {
    Trial run(scene());
    first_ = run.render();
    save_guide(path_, run.loaded.job);
  }
  /// What loading says of a scene.
  std::string refusal(const std::string& text) const {
    try {
      Trial run(text, path_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_ / "a.guide";
  Image first_;
};

TEST_F(GuideFile, GivesTheSameImages) {
  Trial run(scene(), path_);
  const Image image = run.render();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_EQ(image.pixels[i], first_.pixels[i]) << i;
  EXPECT_NO_THROW(expect_guide_is_used(path_, run.loaded.job));
}

// Learned for other numbers of photons and pixels, and from other random numbers, it differs from what these runs would
// learn; so a run with it is not the same as one without.
TEST_F(GuideFile, SuitsOtherSizesSeedsAndPhotons) {
  Choices choices;
  choices.seed = 7, choices.photons = 1000, choices.quick = true;
  Trial given(scene(), path_, choices), learning(scene(), {}, choices);
  const Image a = given.render(), b = learning.render();
  EXPECT_NO_THROW(expect_guide_is_used(path_, given.loaded.job));
  EXPECT_EQ(a.width, 4);
  int same = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) same += a.pixels[i] == b.pixels[i];
  EXPECT_LT(same, 4);
}

TEST_F(GuideFile, IsNotForAnotherScene) {
  EXPECT_EQ(refusal(scene(kIntegrator, "LightSource \"point\" \"rgb I\" [5 5 6] \"point3 from\" [0 0 1]")),
            "test.dsc:7:1: error: light \"point\" has changed since the guide\n"
            "    7 | LightSource \"point\" \"rgb I\" [5 5 6] \"point3 from\" [0 0 1]\n"
            "      | ^~~~~~~~~~~\n"
            "  a guide suits only the scene that it was learned for; without --guide, dspm learns anew\n");
  EXPECT_NE(refusal(scene(kIntegrator, "")).find("light \"point\" has been removed since the guide"),
            std::string::npos);
  EXPECT_NE(refusal(scene() + "Shape \"sphere\"").find("shape \"sphere\" is new since the guide"), std::string::npos);
}

TEST_F(GuideFile, IsNotForOtherSettings) {
  for (const char* words :
       {R"("string direct" "photons" "integer maxdepth" 3)", R"("string direct" "photons" "float gatheralpha" .1)",
        R"("string direct" "photons" "float radius" .1)", R"("string direct" "sampled")"}) {
    Trial run(scene(R"("dsppm" "integer photons" 20000 )" + std::string(words)), path_);
    EXPECT_THROW(run.render(), UsageError) << words;
  }
  Trial sppm(scene(R"("sppm" "string direct" "photons" "integer photons" 20000)"), path_);
  EXPECT_NO_THROW(sppm.render());
}

TEST_F(GuideFile, MustBeOfUse) {
  for (const char* integrator : {"\"path\"", R"("dsppm" "string emission" "power")"}) {
    Trial run(scene(integrator), path_);
    run.render();
    EXPECT_THROW(expect_guide_is_used(path_, run.loaded.job), UsageError) << integrator;
    EXPECT_THROW(save_guide(directory_ / "none", Trial(scene(integrator)).loaded.job), UsageError) << integrator;
  }
}

TEST_F(GuideFile, IsRefusedIfDamaged) {
  const std::string whole = read_bytes(path_);
  const auto refused = [&](const std::string& bytes) {
    put_file(path_, bytes);
    const std::string said = refusal(scene());
    return said.find("it is damaged") != said.npos || said.find("it is not a guide of this version") != said.npos;
  };
  for (std::size_t byte = 0; byte < whole.size(); byte += 1 + whole.size() / 300) {
    std::string damaged = whole;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 0x10);
    EXPECT_TRUE(refused(damaged)) << byte;
    EXPECT_TRUE(refused(whole.substr(0, byte))) << byte;
  }
  EXPECT_TRUE(refused(whole + "x"));
  EXPECT_FALSE(refused(whole));
}

// Two kinds of photons, of which one guide may be off.
TEST_F(GuideFile, HoldsAllThatWasLearned) {
  const std::string text = scene(R"("photonmap" "integer photons" 5000 "integer causticphotons" 5000)") +
                           "Material \"dielectric\" Translate 0 0 .4 Shape \"sphere\" \"float radius\" .3";
  Trial first(text);
  const Image a = first.render();
  save_guide(path_, first.loaded.job);
  Trial second(text, path_);
  const Image b = second.render();
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_EQ(a.pixels[i], b.pixels[i]) << i;
}

}  // namespace guide_file_test
}  // namespace dspm::test
