// Every integrator, and the light tracer, against reference pictures of our own, block by block.
#include <gtest/gtest.h>

#include "tests/integrators/references.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace own_references_test {

struct Way {
  const char* integrator;
  int iterations;
};
constexpr Way kWays[] = {
    {R"("path")", 4},
    {R"("sppm" "string estimator" "hj09" "integer photons" 20000 "float radius" 0.03)", 2},
    {R"("dsppm" "string estimator" "kz11" "integer photons" 20000 "float radius" 0.03)", 2},
    {R"("dsppm" "string estimator" "hj09" "string direct" "sampled" "integer photons" 20000 "float radius" 0.03)", 2},
    {R"("photonmap" "integer photons" 30000 "integer causticphotons" 30000 "float radius" 0.06
  "float causticradius" 0.03)",
     1}};
constexpr double kBlurOfBlocks = 0.015, kBlurOfTheWhole = 0.005;

// All of them together fail right integrators with a chance of 1%.
constexpr double kLevel = 0.01 / static_cast<double>(2 * std::size(kReferences) * (std::size(kWays) + 1));

Tiles whole(const Tiles& blocks) { return {{blocks.means.end() - 3, blocks.means.end()}, blocks.renders}; }

void expect_agreement(const std::string& what, const Tiles& found, const Tiles& expected, double blocks, double all) {
  const Verdict of_blocks = agreement(found, expected, {kLevel, blocks});
  EXPECT_TRUE(of_blocks.passed) << what << ": " << of_blocks.message;
  const Verdict of_all = agreement(whole(found), whole(expected), {kLevel, all});
  EXPECT_TRUE(of_all.passed) << what << ", the whole: " << of_all.message;
}

class OwnReferences : public testing::TestWithParam<const char*> {};

TEST_P(OwnReferences, IntegratorsAgree) {
  const Tiles expected = read_blocks(GetParam());
  for (const Way& way : kWays) {
    const std::string options = fmt::format("Integrator {} \"integer maxdepth\" {}\n", way.integrator, kReferenceDepth);
    expect_agreement(way.integrator, Reference(GetParam(), options).rendered(way.iterations, seeds(10)), expected,
                     kBlurOfBlocks, kBlurOfTheWhole);
  }
}

TEST_P(OwnReferences, LightTracerAgrees) {
  expect_agreement("light tracer", Reference(GetParam(), "").light_traced(30'000, seeds(10)), read_blocks(GetParam()),
                   0, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, OwnReferences, testing::ValuesIn(kReferences),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace own_references_test
}  // namespace dspm::test
