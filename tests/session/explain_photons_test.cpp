// What --explain says of photons comes from what a render learns, and changes no render.
#include "dspm/session/explain_photons.h"

#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/stage.h"

namespace dspm {
namespace explain_photons_test {

// Of lamps of one place, the guide is for light that comes straight from them only if photons bring it.
constexpr const char* kGuided = R"("dsppm" "string direct" "photons")";

/// A lamp above the part of a wide floor that the camera sees, and a ball that moves.
std::string scene(const std::string& integrator) {
  return "Frames 3\nIntegrator " + integrator + R"( "integer photons" 20000
LookAt 0 0 2  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "distant" "rgb L" [2 2 2] "string name" "sun"
LightSource "point" "rgb I" [5 5 5] "point3 from" [0 0 1] "string name" "lamp"
Shape "disk" "float radius" 50
DynamicBegin "ball" Keyframe 1 Translate 0 0 .3 Keyframe 3 Translate .5 0 .3 KeyframeEnd
Shape "sphere" "float radius" .2
DynamicEnd
)";
}

struct Explained {
  Diagnostics diagnostics;
  Messages messages{true};
  LoadedScene loaded;
  std::vector<std::string> lines;

  explicit Explained(const std::string& integrator, std::vector<FileFrame> frames = {FileFrame(1)})
      : loaded("test.dsc", scene(integrator), Choices{}, diagnostics) {
    loaded.job.settings.count_found = true;
    lines = explain_photons(loaded, frames, messages);
  }
  std::string all() const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  }
};

std::vector<Rgb> rendered(const LoadedScene& loaded) {
  Messages messages(true);
  Stage stage(loaded, {FileFrame(1)});
  stage.make_integrator(messages);
  stage.iterate(0);
  return stage.integrator().estimate(0).pixels;
}

TEST(ExplainPhotons, TellsWhatWasLearned) {
  const std::string text = Explained(kGuided).all();
  EXPECT_EQ(text.find("photons: start where a guide says, learned in "), 0u) << text;
  EXPECT_NE(text.find("\nphotons of sun: "), text.npos) << text;
  EXPECT_NE(text.find("\nphotons of lamp: "), text.npos) << text;
}

TEST(ExplainPhotons, TellsWhatStartsByPower) {
  const std::string text = Explained(R"("dsppm" "string indirect" "photons" "string emission" "power")").all();
  EXPECT_EQ(text.find("photons: start by the lights' power, as \"string emission\" \"power\" says."), 0u) << text;
}

// Frame by frame, all together, or each alone: they learn from the file.
TEST(ExplainPhotons, SaysTheSameOfAllFrames) {
  EXPECT_EQ(Explained(kGuided).lines, Explained(kGuided, {FileFrame(0), FileFrame(1), FileFrame(2)}).lines);
  EXPECT_EQ(Explained(kGuided).lines, Explained(R"("sppm" "string direct" "photons")").lines);
}

TEST(ExplainPhotons, ChangesNoImage) {
  for (const char* integrator : {kGuided, R"("dsppm" "string emission" "power")"}) {
    const Explained explained(integrator);
    Diagnostics diagnostics;
    const LoadedScene plain("test.dsc", scene(integrator), Choices{}, diagnostics);
    const std::vector<Rgb> a = rendered(explained.loaded), b = rendered(plain);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], b[i]) << i;
  }
}

// As in the first iteration of a render, so learning is not done twice.
TEST(ExplainPhotons, IsKnownToARender) {
  const Explained explained(kGuided);
  const std::size_t bytes = explained.loaded.job.settings.file->bytes();
  EXPECT_GT(bytes, 0u);
  rendered(explained.loaded);
  EXPECT_EQ(explained.loaded.job.settings.file->bytes(), bytes);
}

}  // namespace explain_photons_test
}  // namespace dspm
