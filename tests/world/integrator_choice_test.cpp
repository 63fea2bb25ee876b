// Which integrator renders: names that several renderers use for different things.
#include "dspm/session/job/integrator_choice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "dspm/session/load.h"
#include "tests/support/idle_integrator.h"

namespace dspm {
namespace integrator_choice_test {

std::unique_ptr<Integrator> make_idle(ParamReader& params, const Scene&, const RenderSettings&) {
  params.finish();
  return std::make_unique<test::IdleIntegrator>();
}

std::string integrator_of(const std::string& name) {
  Diagnostics diagnostics;
  const LoadedScene loaded("test.pbrt", "Integrator \"" + name + "\" WorldBegin Shape \"sphere\"", {}, diagnostics);
  return loaded.job.integrator;
}

TEST(IntegratorChoice, PathAndVcmAnswerToNamesOfPbrt) {
  for (const char* name : {"volpath", "simplepath", "simplevolpath", "randomwalk"}) {
    EXPECT_EQ(stand_in_for(name), "path");
    EXPECT_EQ(integrator_of(name), "path");
  }
  for (const char* name : {"bdpt", "mlt", "lightpath"}) EXPECT_EQ(integrator_of(name), "vcm");
  for (const char* name : {"path", "vcm", "ao", "function"}) EXPECT_EQ(stand_in_for(name), "");
  EXPECT_THROW(integrator_of("ao"), SceneError);
}

TEST(IntegratorChoice, RegularizeIsANote) {
  for (const char* word : {"true", "false"}) {
    Diagnostics diagnostics;
    const std::string text =
        fmt::format("Integrator \"path\" \"bool regularize\" {} WorldBegin Shape \"sphere\"", word);
    const LoadedScene loaded("test.pbrt", text, {}, diagnostics);
    const auto notes = std::count_if(diagnostics.all().begin(), diagnostics.all().end(), [](const Diagnostic& said) {
      return said.message.find("not regularized") != std::string::npos;
    });
    EXPECT_EQ(notes, word == std::string("true") ? 1 : 0);
  }
}

TEST(IntegratorChoice, BdptIsVcmWithoutMergingAndKeepsItsDepth) {
  Diagnostics diagnostics;
  const std::string text = R"(
Integrator "bdpt" "integer maxdepth" 3 "bool visualizestrategies" true
WorldBegin Shape "sphere")";
  const LoadedScene loaded("test.pbrt", text, {}, diagnostics);
  const ParamList& params = loaded.job.params;
  EXPECT_EQ(std::get<std::vector<int>>(params.find("maxdepth")->values), std::vector<int>{3});
  EXPECT_EQ(std::get<std::vector<bool>>(params.find("merge")->values), std::vector<bool>{false});
  EXPECT_EQ(params.find("visualizestrategies"), nullptr);
}

int integer(const ParamList& params, const char* name) {
  return std::get<std::vector<int>>(params.find(name)->values).at(0);
}

TEST(IntegratorChoice, SppmOfAPbrtFileHasPbrtsDefaults) {
  Diagnostics diagnostics;
  const std::string world = "WorldBegin Shape \"sphere\"";
  const LoadedScene pbrt("a.pbrt", "Sampler \"halton\" \"integer pixelsamples\" 7 Integrator \"sppm\" " + world, {},
                         diagnostics);
  EXPECT_EQ(integer(pbrt.job.params, "photonsperiteration"), -1);
  EXPECT_EQ(integer(pbrt.job.params, "maxdepth"), 5);
  EXPECT_EQ(std::get<std::vector<float>>(pbrt.job.params.find("radius")->values), std::vector<float>{1});
  EXPECT_EQ(pbrt.job.settings.default_iterations, 7);
  const LoadedScene given("a.pbrt", "Integrator \"sppm\" \"float radius\" 2 \"integer photons\" 9 " + world, {},
                          diagnostics);
  EXPECT_EQ(std::get<std::vector<float>>(given.job.params.find("radius")->values), std::vector<float>{2});
  EXPECT_EQ(given.job.params.find("photonsperiteration"), nullptr);
  const LoadedScene dsc("a.dsc", "Integrator \"sppm\" " + world, {}, diagnostics);
  EXPECT_EQ(dsc.job.params.find("radius"), nullptr);
}

TEST(IntegratorChoice, PathsPerPixelOfAPbrtFileAreAsManyAsInPbrt) {
  const auto samples = [](const char* file, const std::string& sampler) {
    Diagnostics diagnostics;
    return LoadedScene(file, sampler + " WorldBegin Shape \"sphere\"", {}, diagnostics).job.settings.default_iterations;
  };
  EXPECT_EQ(samples("a.pbrt", ""), 16);
  EXPECT_EQ(samples("a.pbrt", "Sampler \"halton\""), 16);
  EXPECT_EQ(samples("a.pbrt", "Sampler \"stratified\""), 16);
  EXPECT_EQ(samples("a.pbrt", "Sampler \"independent\""), 4);
  EXPECT_EQ(samples("a.pbrt", "Sampler \"independent\" \"integer pixelsamples\" 9"), 9);
  EXPECT_EQ(samples("a.dsc", ""), 256);
}

TEST(IntegratorChoice, PathStandsInForFunctionWhereLenient) {
  EXPECT_THROW(integrator_of("function"), SceneError);
  Diagnostics diagnostics(true);
  Choices choices;
  choices.lenient = true;
  const LoadedScene loaded("test.pbrt",
                           "Integrator \"function\" \"string function\" \"step\" WorldBegin Shape \"sphere\"", choices,
                           diagnostics);
  EXPECT_EQ(loaded.job.integrator, "path");
  ASSERT_FALSE(diagnostics.all().empty());
  EXPECT_NE(diagnostics.all().front().hint.find("\"path\" renders the scene"), std::string::npos);
}

TEST(IntegratorChoice, ButAModulesIntegratorOfThatNameComesFirst) {
  integrator_plugins().add({{"simplepath", "does nothing", make_idle}});
  EXPECT_EQ(integrator_of("simplepath"), "simplepath");
  EXPECT_EQ(integrator_of("volpath"), "path");
}

}  // namespace integrator_choice_test
}  // namespace dspm
