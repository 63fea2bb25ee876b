// No light is lost or made up: in every frame, what lamps emit is absorbed, escapes, or is cut off, and what Russian
// roulette takes from some paths it gives to others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/testing/agreement.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/random_scene.h"

namespace dspm {
namespace energy_test {

using test::TestScene;

/// The balance of each iteration alone: by iteration, then by frame.
std::vector<std::vector<EnergyBalance>> balances(const std::string& text, int iterations) {
  TestScene test(text);
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  std::vector<std::vector<EnergyBalance>> all;
  std::vector<EnergyBalance> before(static_cast<std::size_t>(test.frame_count()));
  for (int i = 0; i < iterations; ++i) {
    integrator->iterate({i, *scene});
    const std::vector<EnergyBalance> sum = integrator->statistics().energy;
    all.push_back(sum);
    for (std::size_t f = 0; f < sum.size(); ++f) all.back()[f] += before[f] * -1;
    before = sum;
  }
  return all;
}

/// Student's t-test: iterations have photons of their own, so their mean has a standard error.
void expect_mean(const std::vector<double>& samples, double expected, double level) {
  const auto n = static_cast<double>(samples.size());
  double mean = 0, squares = 0;
  for (const double s : samples) mean += s / n;
  for (const double s : samples) squares += (s - mean) * (s - mean);
  const double error = std::sqrt(squares / (n * (n - 1))) + 1e-7;  // and rounding
  const double chance = test::student_tails((mean - expected) / error, static_cast<int>(samples.size()) - 1);
  EXPECT_GE(chance, level) << fmt::format("{:.5f} instead of {:.5f}, with a standard error of {:.2g}", mean, expected,
                                          error);
}

class Energy : public testing::TestWithParam<const char*> {};

TEST_P(Energy, IsKeptInEveryFrame) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::string text = test::RandomScene(seed, 6).text(std::string("Integrator ") + GetParam());
    SCOPED_TRACE(text);
    const auto iterations = balances(text, 1);
    for (const EnergyBalance& e : iterations[0]) {
      EXPECT_GT(e.emitted, 0);
      EXPECT_NEAR((e.absorbed + e.escaped + e.terminated + e.roulette) / e.emitted, 1, 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, Energy,
    testing::Values(R"("dsppm" "string indirect" "photons" "integer photons" 5000)",
                    R"("photonmap" "integer photons" 5000 "integer causticphotons" 5000)",
                    R"("photonmap" "integer photons" 5000 "integer causticphotons" 5000 "integer finalgather" 1)"));

// A path that carries x survives with the chance p and then carries x / p, so that roulette takes x with the chance
// 1 - p and gives x / p - x with the chance p: nothing in the mean, whatever p is. A survivor that is not divided by p
// gives nothing back; one that is divided twice gives too much.
TEST(EnergyOfPhotons, RouletteGivesWhatItTakes) {
  constexpr int kScenes = 12, kFrames = 6;
  for (unsigned seed = 0; seed < kScenes; ++seed) {
    const std::string text =
        test::RandomScene(seed, kFrames)
            .text(R"(Integrator "dsppm" "string indirect" "photons" "integer photons" 1000 "integer maxdepth" 32)");
    SCOPED_TRACE(text);
    const auto iterations = balances(text, 24);
    for (std::size_t f = 0; f < kFrames; ++f) {
      std::vector<double> net;
      for (const auto& frames : iterations) net.push_back(frames[f].roulette / frames[f].emitted);
      expect_mean(net, 0, 0.01 / (kScenes * kFrames));
    }
  }
}

// A lamp of power P in a closed sphere of albedo a: the first hit absorbs (1 - a) P, the second (1 - a) a P, ... With
// at most n hits the sum is (1 - a^(n-1)) P, and a^(n-1) P reaches the last hit, where it is cut off. Roulette goes by
// the brightest channel, so that the weights of the others change with every bounce.
TEST(EnergyOfPhotons, IsAbsorbedAsTheAlbedoSays) {
  const double albedo[] = {0.8, 0.5, 0.3};
  constexpr int kDepths[] = {2, 3, 5, 8};
  for (const int depth : kDepths) {
    SCOPED_TRACE(depth);
    std::string text = test::furnace(
        fmt::format(R"("dsppm" "integer photons" 5000 "integer maxdepth" {} "string indirect" "photons")", depth),
        0.25f);
    const std::string grey = "[0.25 0.25 0.25]";
    text.replace(text.find(grey), grey.size(), fmt::format("[{} {} {}]", albedo[0], albedo[1], albedo[2]));
    double reaches_last = 0;
    for (const double a : albedo) reaches_last += std::pow(a, depth - 1) / 3;
    std::vector<double> absorbed, terminated;
    for (const auto& frames : balances(text, 24)) {
      const EnergyBalance& e = frames[0];
      absorbed.push_back(e.absorbed / e.emitted), terminated.push_back(e.terminated / e.emitted);
      EXPECT_EQ(e.escaped, 0);
      // pi L A = pi * 1 * 4 pi 2^2, three channels, 5000 paths
      EXPECT_NEAR(e.emitted / (3 * 5000.0 * 16 * 3.14159265 * 3.14159265), 1, 0.002);
    }
    expect_mean(absorbed, 1 - reaches_last, 0.01 / (2 * std::size(kDepths)));
    expect_mean(terminated, reaches_last, 0.01 / (2 * std::size(kDepths)));
  }
}

// Through a clear glass ball nothing is lost: all of a lamp's light leaves the scene.
TEST(EnergyOfPhotons, GlassKeepsAll) {
  const EnergyBalance e =
      balances(R"(Integrator "dsppm" "string indirect" "photons" "integer photons" 50000 "integer maxdepth" 60
LookAt 0 0 -4 0 0 0 0 1 0
Camera "perspective"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
LightSource "point" "point3 from" [0.2 0.1 0.3]
Material "dielectric" "float eta" 1.5
Shape "sphere" "float radius" 1)",
               1)[0][0];
  EXPECT_NEAR(e.escaped / e.emitted, 1, 1e-3);
  EXPECT_NEAR(e.absorbed / e.emitted, 0, 1e-3);
}

}  // namespace energy_test
}  // namespace dspm
