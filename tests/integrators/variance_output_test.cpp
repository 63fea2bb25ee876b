// The estimated variance of pixels against the spread of runs with other seeds.
#include "dspm/integrators/beside/variance_output.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace variance_output_test {

constexpr int kIterations = 16, kSeeds = 12;

TestScene with_variance(const std::string& integrator, const std::string& numbers = "even") {
  Choices choices;
  choices.outputs = {kVarianceOutput};
  return TestScene(box("Option \"numbers\" \"" + numbers + "\" Integrator " + integrator, ""), choices);
}

/// Of all pixels' green, the mean variance: as estimated, and as seen between seeds.
void expect_right(const std::string& integrator, double tolerance, const std::string& numbers = "even") {
  TestScene test = with_variance(integrator, numbers);
  std::vector<Image> images;
  double estimated = 0, seen = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    test.set_seed(static_cast<std::uint64_t>(seed));
    const auto scene = test.scene(test.all_frames());
    const auto made = test.integrator(*scene);
    for (int i = 0; i < kIterations; ++i) made->iterate({i, *scene});
    images.push_back(made->estimate(0));
    for (const Rgb& variance : made->estimate(0, kVarianceOutput).pixels) estimated += double(variance.g) / kSeeds;
  }
  for (std::size_t i = 0; i < images.front().pixels.size(); ++i) {
    double sum = 0, squares = 0;
    for (const Image& image : images) {
      const double value = double(image.pixels[i].g);
      sum += value, squares += value * value;
    }
    seen += (squares - sum * sum / kSeeds) / (kSeeds - 1);
  }
  EXPECT_NEAR(estimated / seen, 1, tolerance) << integrator;
}

TEST(VarianceOutput, IsThatOfOtherSeeds) {
  expect_right(R"("path" "integer maxdepth" 4)", 0.1, "independent");
  expect_right(R"("path" "integer maxdepth" 4)", 0.2);
  expect_right(R"("dsppm" "integer photons" 2000 "integer maxdepth" 4)", 0.2);
  expect_right(R"("dsppm" "string estimator" "hj09" "integer photons" 2000 "integer maxdepth" 4)", 0.4);
}

TEST(VarianceOutput, IsUnknownAfterOneIteration) {
  TestScene test = with_variance(R"("path" "integer maxdepth" 4)");
  const auto scene = test.scene(test.all_frames());
  const auto made = test.integrator(*scene);
  made->iterate({0, *scene});
  for (const Rgb& variance : made->estimate(0, kVarianceOutput).pixels) EXPECT_EQ(variance, Rgb());
}

}  // namespace variance_output_test
}  // namespace dspm::test
