// Warnings in runs that go badly, and none in those that do not.
#include "dspm/session/run_warnings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "dspm/session/session.h"
#include "dspm/testing/scenes.h"

namespace dspm::test {
namespace run_warnings_test {

struct Heard final : Messages {
  Heard() : Messages(true) {}
  void print(std::string_view text) const override { all += text; }
  mutable std::string all;
};

std::string ball(float radius) {
  return fmt::format("AttributeBegin Translate 0 -0.6 0 Shape \"sphere\" \"float radius\" {} AttributeEnd\n", radius);
}

/// What a run of the box with these contents is warned of.
std::string warnings(const std::string& integrator, const std::string& contents = ball(0.4f), int size = 32) {
  Diagnostics diagnostics;
  const std::string text = box("Integrator " + integrator, contents, size);
  const LoadedScene loaded("test.dsc", text, {}, diagnostics);
  Heard messages;
  MemoryBound memory(0);
  SessionObserver observer;
  const std::vector<FrameList> intervals = memory.plan(loaded.job, *loaded.world, {}, {}, messages, observer);
  Session(loaded, intervals, memory, {}, messages, observer).run();
  return messages.all;
}

TEST(RunWarnings, AGoodRunHasNone) {
  for (const char* integrator : {"dsppm", "sppm", "photonmap", "path"})
    EXPECT_EQ(warnings('"' + std::string(integrator) + R"(" "integer iterations" 32)" +
                       (std::string(integrator).ends_with("sppm") ? R"( "integer photons" 20000)" : "")),
              "")
        << integrator;
}

TEST(RunWarnings, FewPhotonsMakeGrain) {
  const std::string text =
      warnings(R"("dsppm" "integer iterations" 40 "integer photons" 30 "string direct" "photons")");
  EXPECT_NE(text.find("warning: 8 iterations have found "), std::string::npos) << text;
  EXPECT_NE(text.find("\"string direct\" \"both\""), std::string::npos) << text;
  EXPECT_EQ(text.find("warning:"), text.rfind("warning:")) << text;
}

TEST(RunWarnings, ManyIterationsMakeUpForFewPhotons) {
  EXPECT_EQ(warnings(R"("dsppm" "integer iterations" 300 "integer photons" 400)"), "");
}

TEST(RunWarnings, TheHintIsWhatTheSceneDoesNotSayYet) {
  const std::string all = warnings(
      R"("dsppm" "integer iterations" 40 "integer photons" 30 "string emission" "power" "string indirect" "photons")");
  const std::string text = all.substr(0, all.find("warning:", 1));
  EXPECT_EQ(text.find("\"string direct\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"string emission\" \"guided\""), std::string::npos) << text;
}

TEST(RunWarnings, AWideRadiusBlurs) {
  const std::string text = warnings(R"("dsppm" "integer iterations" 40 "integer photons" 2000 "float radius" 3)");
  EXPECT_NE(text.find("what is finer than that is blurred"), std::string::npos) << text;
  EXPECT_NE(text.find("\"float radius\""), std::string::npos) << text;
}

TEST(RunWarnings, ALowMaximumDepthCutsLight) {
  const std::string text = warnings(
      R"("dsppm" "integer iterations" 8 "integer photons" 5000 "integer maxdepth" 2 "string indirect" "photons")");
  EXPECT_NE(text.find("of the photons' flux"), std::string::npos) << text;
  EXPECT_NE(text.find("\"integer maxdepth\""), std::string::npos) << text;
}

// Six boundaries of glass and a wall behind them are more than five scatterings. The balls are a tenth of the picture.
TEST(RunWarnings, ALowMaximumDepthDarkensGlass) {
  const std::string balls = "Material \"dielectric\"\n" + ball(0.38f) + ball(0.34f) + ball(0.3f);
  for (const std::string integrator : {R"("path" "integer iterations" 8)", R"("vcm" "integer iterations" 8)"}) {
    const std::string text = warnings(integrator + R"( "integer maxdepth" 5)", balls, 64);
    EXPECT_NE(text.find("% of the light in"), std::string::npos) << text;
    EXPECT_NE(text.find("--maxdepth"), std::string::npos) << text;
    EXPECT_EQ(warnings(integrator + R"( "integer maxdepth" 40)", balls, 64), "");
  }
}

// Its dark corners lack up to 9% of their light, but they are dark.
TEST(RunWarnings, ADiffuseBoxNeedsNoMoreThanFiveScatterings) {
  for (const std::string integrator : {"path", "vcm"})
    EXPECT_EQ(warnings("\"" + integrator + R"(" "integer iterations" 8 "integer maxdepth" 5)", ball(0.4f), 64), "");
}

TEST(RunWarnings, ShortRunsAreNotJudged) {
  EXPECT_EQ(warnings(R"("dsppm" "integer iterations" 7 "integer photons" 10 "float radius" 3 "integer maxdepth" 1)"),
            "");
}

}  // namespace run_warnings_test
}  // namespace dspm::test
