// What comes of a scene's directives and the command line's options: which of them goes first, and what they come to.
#include "dspm/session/job/job.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/integrator_choice.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace job_test {

const std::string kWorld = "WorldBegin LightSource \"point\" Shape \"sphere\"";

Job job_of(const std::string& directives, const Choices& options = {}) {
  Job job = test::TestScene(directives + "\n" + kWorld, options).job();
  job.description = nullptr;  // which has gone
  return job;
}

TEST(Job, TheCommandLinesSeedGoesFirstThenTheIntegratorsTheSamplersAndTheOptions) {
  const std::string option = "Option \"seed\" 1 ", sampler = "Sampler \"halton\" \"integer seed\" 2 ",
                    integrator = "Integrator \"path\" \"integer seed\" 3 ";
  EXPECT_EQ(job_of("").settings.seed, 0u);
  EXPECT_EQ(job_of(option).settings.seed, 1u);
  EXPECT_EQ(job_of(option + sampler).settings.seed, 2u);
  EXPECT_EQ(job_of(option + sampler + integrator).settings.seed, 3u);
  Choices options;
  options.seed = 4;
  EXPECT_EQ(job_of(option + sampler + integrator, options).settings.seed, 4u);
}

TEST(Job, TheCommandLinesNoiseGoesFirstThenTheIntegratorsThenTheSamplers) {
  const std::string sampler = "Sampler \"halton\" \"string noise\" \"perframe\" ",
                    frozen = "Integrator \"path\" \"string noise\" \"frozen\" ";
  EXPECT_FALSE(job_of("").settings.noise_per_frame);
  EXPECT_TRUE(job_of(sampler).settings.noise_per_frame);
  EXPECT_FALSE(job_of(sampler + frozen).settings.noise_per_frame);
  Choices options;
  options.noise = "perframe";
  EXPECT_TRUE(job_of(sampler + frozen, options).settings.noise_per_frame);
  EXPECT_THROW(job_of("Integrator \"path\" \"string noise\" \"own\""), SceneError);
}

TEST(Job, SamplesOfAPixelAreTheIterationsOfIntegratorsThatNameNone) {
  EXPECT_EQ(job_of("Sampler \"halton\" \"integer pixelsamples\" 12").settings.default_iterations, 12);
  EXPECT_EQ(job_of("Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5").settings.default_iterations,
            15);
  EXPECT_EQ(job_of("Sampler \"stratified\" \"integer xsamples\" 3").settings.default_iterations, 12);
}

TEST(Job, AnImageMayBeTooLarge) {
  try {
    job_of("Film \"rgb\" \"integer xresolution\" 20000 \"integer yresolution\" 20000");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("20000 x 20000 pixels are more than the 268 million"), std::string::npos)
        << error.what();
  }
}

TEST(Job, AnAcceleratorsParametersAreRead) {
  const auto message_of = [](const std::string& directive, const Choices& choices = {}) {
    try {
      job_of("Accelerator " + directive, choices);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of(R"("two-level" "string static" "own")"), "");
  EXPECT_NE(message_of(R"("two-level" "string static" "octree")").find("embree"), std::string::npos);
  EXPECT_NE(message_of(R"("two-level" "string statik" "own")").find("did you mean \"static\""), std::string::npos);
  EXPECT_NE(message_of(R"("bruteforce" "string static" "own")"), "");
  EXPECT_EQ(message_of(R"("kdtree" "integer maxdepth" 9)"), "");  // pbrt's, without effect
  Choices other;
  other.accel = "bruteforce";
  EXPECT_EQ(message_of(R"("two-level" "string static" "own")", other), "");  // not what these parameters are for
}

TEST(Job, PixelsAreJitteredUnlessTheSceneSaysElse) {
  EXPECT_TRUE(job_of("").settings.jitter);
  EXPECT_TRUE(job_of("Option \"disablepixeljitter\" false").settings.jitter);
  EXPECT_FALSE(job_of("Option \"disablepixeljitter\" true").settings.jitter);
}

TEST(Job, AQuickLookTakesAQuarterOfTheIterationsAndOfEachSide) {
  const std::string film = "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 24 ";
  const std::string integrator = "Integrator \"path\" \"integer iterations\" 30";
  Choices quick, quick_and_five;
  quick.quick = quick_and_five.quick = true;
  quick_and_five.iterations = 5;
  const auto iterations_of = [&](const Choices& choices) {
    test::TestScene test(film + integrator + "\n" + kWorld, choices);
    const auto scene = test.scene({FileFrame(0)});
    return test.job().iterations(*test.integrator(*scene));
  };
  EXPECT_EQ(iterations_of(quick), 7);
  EXPECT_EQ(iterations_of({}), 30);
  EXPECT_EQ(iterations_of(quick_and_five), 5);
  const test::TestScene test(film + integrator + "\n" + kWorld, quick);
  EXPECT_EQ(test.job().settings.crop, (PixelRect{0, 0, 10, 6}));
}

TEST(Job, AQuickLookHasAsManyPhotonsForAPixel) {
  Choices quick, quick_and_chosen;
  quick.quick = quick_and_chosen.quick = true;
  quick_and_chosen.photons = 1000;
  const auto photons_of = [&](const std::string& integrator, const Choices& choices) {
    const test::TestScene test("Integrator " + integrator + "\n" + kWorld, choices);
    return integer_of(test.job().params, "photons", 0);
  };
  EXPECT_EQ(photons_of(R"("dsppm" "integer photons" 1600)", quick), 100);
  EXPECT_EQ(photons_of(R"("sppm" "integer photonsperiteration" 1600)", quick), 100);
  EXPECT_EQ(photons_of(R"("dsppm")", quick), 300'000 / 16) << "in proportion to the default";
  EXPECT_EQ(photons_of(R"("dsppm" "integer photons" -1)", quick), -1) << "one for each pixel, whatever their number";
  EXPECT_EQ(photons_of(R"("dsppm" "integer photons" 1600)", quick_and_chosen), 1000);
  EXPECT_EQ(photons_of(R"("path")", quick), 0);
}

TEST(Job, TheDepthIsThatOfTheCommandLine) {
  const auto depth_of = [](const std::string& integrator) {
    Choices choices;
    choices.max_depth = 33;
    const test::TestScene test("Integrator " + integrator + "\n" + kWorld, choices);
    return integer_of(test.job().params, "maxdepth", 0);
  };
  for (const char* name : {"path", "vcm", "dsppm", "sppm", "photonmap"})
    EXPECT_EQ(depth_of(fmt::format("\"{}\" \"integer maxdepth\" 3", name)), 33) << name;
  EXPECT_EQ(depth_of("\"path\""), 33);
  EXPECT_THROW(depth_of("\"ambientocclusion\""), UsageError);
}

TEST(Job, TheResolutionIsChosen) {
  Choices half, other, both;
  half.resolution = both.resolution = Resolution{.share = 0.5};
  other.resolution = Resolution{.width = 30, .height = 20};
  both.quick = true;
  const auto size_of = [&](const Choices& choices) {
    const test::TestScene test(
        R"(Film "rgb" "integer xresolution" 80 "integer yresolution" 64)" + std::string("\n") + kWorld, choices);
    return std::pair(test.job().settings.width, test.job().settings.height);
  };
  EXPECT_EQ(size_of(half), std::pair(40, 32));
  EXPECT_EQ(size_of(other), std::pair(30, 20));
  EXPECT_EQ(size_of(both), std::pair(10, 8)) << "a quarter of the chosen one";
}

}  // namespace job_test
}  // namespace dspm
