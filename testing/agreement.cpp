#include "dspm/testing/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/image/shrink.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace {

constexpr double kRoundingOfSums = 1e-5;  // relative, of sums in single precision

/// Appends the colours of a frame's tiles and of the whole, one after the other.
void append_colours(const Image& image, int across, std::vector<double>& colours) {
  for (const Image& small : {shrunk(image, across, across), shrunk(image, 1, 1)})
    for (const Rgb& c : small.pixels)
      for (int channel = 0; channel < 3; ++channel) colours.push_back(static_cast<double>(c[channel]));
}

/// Returns the degrees of freedom of the difference of two means with unequal variances [Welch 1947], rounded down.
int degrees_of_freedom(const Tiles& a, const Tiles& b, std::size_t i) {
  const double va = a.means[i].variance, vb = b.means[i].variance;
  const double share = va * va / std::max(1, a.renders - 1) + vb * vb / std::max(1, b.renders - 1);
  return std::max(1, static_cast<int>((va + vb) * (va + vb) / share));
}

}  // namespace

Tiles tiles_of(const std::vector<std::vector<Image>>& renders, int across) {
  std::vector<std::vector<double>> colours(renders.size());
  for (std::size_t r = 0; r < renders.size(); ++r)
    for (const Image& frame : renders[r]) append_colours(frame, across, colours[r]);
  const auto n = static_cast<double>(renders.size());
  Tiles tiles;
  tiles.renders = static_cast<int>(renders.size());
  for (std::size_t i = 0; i < colours.front().size(); ++i) {
    double mean = 0, squares = 0;
    for (const auto& render : colours) mean += render[i] / n;
    for (const auto& render : colours) squares += (render[i] - mean) * (render[i] - mean);
    tiles.means.push_back({mean, squares / (n * std::max(1., n - 1))});
  }
  return tiles;
}

Tiles rendered(const std::string& scene, int iterations, int seeds, int across) {
  TestScene test(scene);
  std::vector<std::vector<Image>> renders;
  for (int seed = 1; seed <= seeds; ++seed) {
    test.set_seed(static_cast<std::uint64_t>(seed));
    renders.push_back(test.render_all(iterations));
  }
  return tiles_of(renders, across);
}

// [Abramowitz and Stegun 26.7.3, 26.7.4]
double student_tails(double t, int degrees_of_freedom) {
  const int n = degrees_of_freedom;
  const double angle = std::atan(std::abs(t) / std::sqrt(static_cast<double>(n)));
  const double cos = std::cos(angle), sin = std::sin(angle);
  const bool odd = n % 2 == 1;
  double term = odd ? cos : 1, sum = n > 1 ? term : 0;
  for (int k = odd ? 2 : 1; k <= n - 3; k += 2) sum += term *= cos * cos * k / (k + 1);
  const double within = odd ? 2 / std::acos(-1.) * (angle + sin * sum) : sin * sum;
  return std::max(0., 1 - within);
}

Verdict agreement(const Tiles& a, const Tiles& b, const Tolerance& tolerance) {
  Verdict verdict;
  if (a.means.size() != b.means.size() || a.means.empty()) {
    verdict.fail(a.means.empty() ? "there are no pictures" : "the pictures do not have the same number of frames");
    return verdict;
  }
  // Sidak: all tests together fail with a chance of `level`.
  const double level = 1 - std::pow(1 - tolerance.level, 1. / static_cast<double>(a.means.size()));
  double least = 1;
  for (std::size_t i = 0; i < a.means.size(); ++i) {
    const Tiles::Mean &mine = a.means[i], &other = b.means[i];
    const double scale = std::max(std::abs(mine.value), std::abs(other.value));
    const double excess = std::abs(mine.value - other.value) - (tolerance.bias + kRoundingOfSums) * scale;
    if (excess <= 0) continue;
    const double error = std::sqrt(mine.variance + other.variance);
    const double chance = error > 0 ? student_tails(excess / error, degrees_of_freedom(a, b, i)) : 0;
    least = std::min(least, chance);
    if (chance < level)
      verdict.fail(
          fmt::format("tile {}, channel {}: {:.5g} against {:.5g}, with a standard error of {:.2g}: "
                      "a chance of {:.1e}, but {:.1e} is the least allowed for {} tests at a level of {}",
                      i / 3, i % 3, mine.value, other.value, error, chance, level, a.means.size(), tolerance.level));
  }
  if (verdict.passed)
    verdict.message =
        fmt::format("{} tests, the least chance {:.2g}, at least {:.1e} allowed", a.means.size(), least, level);
  return verdict;
}

Verdict agreement(const Tiles& a, const Rgb& everywhere, const Tolerance& tolerance) {
  Tiles exact;
  for (std::size_t i = 0; i < a.means.size(); ++i)
    exact.means.push_back({static_cast<double>(everywhere[static_cast<int>(i % 3)]), 0});
  return agreement(a, exact, tolerance);
}

}  // namespace dspm::test
