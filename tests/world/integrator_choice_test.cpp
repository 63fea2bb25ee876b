// Which integrator renders: names that several renderers use for different things.
#include "dspm/world/integrator_choice.h"

#include <gtest/gtest.h>

#include "dspm/session/load.h"
#include "tests/support/idle_integrator.h"

namespace dspm {
namespace {

std::unique_ptr<Integrator> make_idle(ParamReader& params, const Scene&, const RenderSettings&) {
  params.finish();
  return std::make_unique<test::IdleIntegrator>();
}

std::string integrator_of(const std::string& name) {
  Diagnostics diagnostics;
  const LoadedScene loaded("test.pbrt", "Integrator \"" + name + "\" WorldBegin Shape \"sphere\"", {}, diagnostics);
  return loaded.job.integrator;
}

TEST(IntegratorChoice, PathAnswersToNamesOfPbrt) {
  for (const char* name : {"volpath", "simplepath", "simplevolpath"}) {
    EXPECT_TRUE(is_name_of_path(name));
    EXPECT_EQ(integrator_of(name), "path");
  }
  EXPECT_FALSE(is_name_of_path("path"));
}

TEST(IntegratorChoice, ButAModulesIntegratorOfThatNameComesFirst) {
  integrator_plugins().add({{"simplepath", "does nothing", make_idle}});
  EXPECT_EQ(integrator_of("simplepath"), "simplepath");
  EXPECT_EQ(integrator_of("volpath"), "path");
}

}  // namespace
}  // namespace dspm
