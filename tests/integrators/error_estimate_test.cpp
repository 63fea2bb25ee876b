// The estimated error against the true one.
#include "dspm/integrators/beside/error_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/rng.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace error_estimate_test {

constexpr int kIterations = 32;

/// A box with a ball, a mirror if not said otherwise, and a matte one.
std::string scene(const std::string& integrator, const std::string& ball = R"(Material "conductor")") {
  return box("Integrator " + integrator, "AttributeBegin " + ball + R"( Translate -0.4 -0.6 0.2
  Shape "sphere" "float radius" 0.4 AttributeEnd
AttributeBegin Translate 0.5 -0.7 -0.2 Shape "sphere" "float radius" 0.3 AttributeEnd)");
}

struct Rendered {
  Image image;
  double estimated = 0;
};

/// Integrators of all seeds learn once.
TestScene estimating(const std::string& text) {
  Choices choices;
  choices.until_error = 0.01;
  return TestScene(text, choices);
}

Rendered rendered(TestScene& test, std::uint64_t seed, int iterations) {
  test.set_seed(seed);
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  for (int i = 0; i < iterations; ++i) integrator->iterate({i, *scene});
  return {integrator->estimate(0), integrator->statistics().errors.at(0)};
}

double true_error(const Image& image, const Image& truth) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const double value = luminance(image.pixels[i]), right = luminance(truth.pixels[i]);
    if (std::abs(value - right) > 1e-5 * right) errors.push_back(std::abs(value - right) / right);
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

/// What runs of other seeds give on average: so it has the same blur as each of them.
Image mean_of_seeds(TestScene& test, int seeds) {
  Image sum(32, 32);
  for (int seed = 0; seed < seeds; ++seed) {
    const Image image = rendered(test, 100 + static_cast<std::uint64_t>(seed), kIterations).image;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i] / static_cast<float>(seeds);
  }
  return sum;
}

void expect_estimates(TestScene& test, const Image& truth) {
  double estimated = 0, actual = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Rendered run = rendered(test, seed, kIterations);
    estimated += run.estimated / 4, actual += true_error(run.image, truth) / 4;
  }
  EXPECT_NEAR(estimated / actual, 1, 0.2);
}

class ErrorEstimate : public testing::TestWithParam<std::string> {};

TEST_P(ErrorEstimate, IsTheErrorAgainstTheMeanOfOtherRuns) {
  TestScene test = estimating(scene(GetParam()));
  expect_estimates(test, mean_of_seeds(test, 16));
}

/// Without a mirror: path hardly ever finds its caustic, and no halves show light that both of them miss.
TEST(ErrorEstimateOf, PathIsTheErrorAgainstTheMeanOfOtherRuns) {
  TestScene test = estimating(scene(R"("path" "integer maxdepth" 6)", ""));
  expect_estimates(test, mean_of_seeds(test, 16));
}

/// Runs of other seeds have other maps.
TEST(ErrorEstimateOf, PhotonmapIsTheErrorAgainstManyIterationsWithTheSameMaps) {
  TestScene test = estimating(scene(R"("photonmap" "integer photons" 20000 "integer causticphotons" 20000)"));
  double estimated = 0, actual = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Rendered run = rendered(test, seed, kIterations);
    estimated += run.estimated, actual += true_error(run.image, rendered(test, seed, 12 * kIterations).image);
  }
  EXPECT_NEAR(estimated / actual, 1, 0.2);
}

/// Pixels of 1 +- 0.3 an iteration, and one that gets `speck` more in one of them.
class Specks final : public Integrator {
 public:
  explicit Specks(std::vector<int> iterations, float speck) : specks_(std::move(iterations)), speck_(speck) {}
  int iterations() const override { return kIterations; }
  std::string settings() const override { return ""; }
  void iterate(const Iteration& iteration) override {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const PathRandom random(1, Stream::setup, i, static_cast<std::uint64_t>(iteration.number));
      sums_[i] += 0.7f + 0.6f * random.number(0, 0);
    }
    for (std::size_t i = 0; i < specks_.size(); ++i)
      if (specks_[i] == iteration.number) sums_[77 * i + 5] += speck_;
    ++done_;
  }
  Image estimate(Frame, const std::string&) const override {
    Image image(kSide, kSide);
    for (std::size_t i = 0; i < sums_.size(); ++i) image.pixels[i] = Rgb(sums_[i] / static_cast<float>(done_));
    return image;
  }
  Statistics statistics() const override {
    Statistics statistics;
    statistics.iterations = done_;
    return statistics;
  }
  static constexpr int kSide = 90;  // more pixels than the estimate looks at

 private:
  std::vector<int> specks_;
  float speck_;
  std::vector<float> sums_ = std::vector<float>(kSide * kSide);
  int done_ = 0;
};

std::uint64_t lone_paths(const std::vector<int>& iterations, float speck) {
  Scene scene;
  scene.file_frames = {FileFrame(0)};
  const auto integrator = with_error_estimate([&](std::size_t) { return std::make_unique<Specks>(iterations, speck); },
                                              scene, {0, 0, Specks::kSide, Specks::kSide}, 2, 0);
  for (int i = 0; i < kIterations; ++i) integrator->iterate({i, scene});
  const Statistics statistics = integrator->statistics();
  EXPECT_LT(statistics.errors.at(0), 0.03);
  EXPECT_EQ(statistics.steps.back().name, "error estimate");
  EXPECT_GT(statistics.steps.back().seconds, 0);
  for (const Counters::Entry& counter : statistics.counters)
    if (counter.name == kLonePaths) return counter.value;
  return 0;
}

// The median knows of none.
TEST(ErrorEstimateOf, OnePathThatOutweighsAllOthersIsFoundWhenever) {
  EXPECT_EQ(lone_paths({}, 0), 0u);
  EXPECT_EQ(lone_paths({3, 15, 16, 31}, 1.5f * kIterations), 4u);
  EXPECT_EQ(lone_paths({3, 15, 16, 31}, 0.5f * kIterations), 0u);
}

INSTANTIATE_TEST_SUITE_P(Integrators, ErrorEstimate,
                         testing::Values(R"("dsppm" "integer photons" 3000)",
                                         R"("dsppm" "integer photons" 3000 "string estimator" "hj09")",
                                         R"("dsppm" "integer photons" 3000 "string direct" "sampled")"));

}  // namespace error_estimate_test
}  // namespace dspm::test
