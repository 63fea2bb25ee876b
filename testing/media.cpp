#include "dspm/testing/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/media/majorants.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace {

std::string point_text(const Vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }

/// Numbers in [0, 1), one after another.
class Numbers {
 public:
  explicit Numbers(std::uint64_t index) : random_(3, Stream::setup, index, 0) {}
  float operator()() { return random_.number(0, next_++); }
  Vec3 point_in(const Bounds3& box) {
    const Vec3 size = box.extent();
    const float x = (*this)(), y = (*this)(), z = (*this)();
    return box.low + Vec3{size.x * x, size.y * y, size.z * z};
  }

 private:
  PathRandom random_;
  int next_ = 8;
};

Bounds3 extent_of(const Medium& medium) { return medium.extent().value_or(Bounds3{{-1, -1, -1}, {1, 1, 1}}); }

/// The box around the extent that is as far beyond it on each side as it is wide.
Bounds3 wider(const Bounds3& box) {
  const Vec3 size = box.extent();
  return {box.low - size, box.high + size};
}

bool is_within(const Bounds3& box, const Vec3& p) {
  return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
         p.z <= box.high.z;
}

}  // namespace

std::shared_ptr<const Medium> medium_of(const std::string& words, const std::string& place) {
  const TestScene scene("Integrator \"path\"\nWorldBegin\nTransformBegin " + place +
                        "\nMakeNamedMedium \"medium\" \"string type\" " + words +
                        "\nTransformEnd\nMediumInterface \"medium\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n"
                        "MediumInterface \"\" \"\"\nMaterial \"diffuse\"\nShape \"disk\"");
  return scene.scene({FileFrame(0)})->media.front().states.states.front().object;
}

Verdict is_sound(const Medium& medium) {
  constexpr int kPoints = 10'000;
  Verdict verdict;
  Numbers numbers(0);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p = numbers.point_in(wider(extent_of(medium)));
    const MediumProperties here = medium.at(p);
    for (const Rgb& each : {here.sigma_a, here.sigma_s, here.emitted})
      for (int c = 0; c < 3; ++c)
        if (!(each[c] >= 0) || !std::isfinite(each[c]))
          verdict.fail(fmt::format("a property at {} is {}", point_text(p), each[c]));
    if (!(std::abs(here.g) < 1)) verdict.fail(fmt::format("g at {} is {}", point_text(p), here.g));
    if (const auto same = medium.everywhere();
        same && !(same->sigma_a == here.sigma_a && same->sigma_s == here.sigma_s))
      verdict.fail(fmt::format("everywhere() says something else than at({})", point_text(p)));
  }
  if (verdict.passed) verdict.message = fmt::format("{} points", kPoints);
  return verdict;
}

Verdict keeps_to_bounds(const Medium& medium) {
  constexpr int kBoxes = 300, kPoints = 40;
  constexpr float kRounding = 1 + 1e-5f;
  Verdict verdict;
  Numbers numbers(1);
  const Bounds3 extent = extent_of(medium);
  for (int i = 0; i < kBoxes; ++i) {
    Bounds3 box;
    box.add(numbers.point_in(extent)), box.add(numbers.point_in(extent));
    const Rgb most = medium.majorant(box);
    for (int j = 0; j < kPoints; ++j) {
      const Vec3 p = numbers.point_in(box);
      const Rgb here = medium.at(p).sigma_t();
      for (int c = 0; c < 3; ++c)
        if (!(here[c] <= most[c] * kRounding))
          verdict.fail(fmt::format("sigma_t at {} is {}, but the majorant from {} to {} is {}", point_text(p), here[c],
                                   point_text(box.low), point_text(box.high), most[c]));
    }
    const Vec3 outside = numbers.point_in(wider(extent));
    if (medium.extent() && !is_within(extent, outside) && !is_black(medium.at(outside).sigma_t()))
      verdict.fail(fmt::format("{} is outside of the extent, but sigma_t is not 0 there", point_text(outside)));
  }
  if (verdict.passed) verdict.message = fmt::format("{} boxes", kBoxes);
  return verdict;
}

Verdict lets_light_through(const Medium& medium) {
  constexpr int kLines = 24, kRays = 4'000, kSteps = 4'000;
  constexpr double kDeviations = 4.5;  // of 24 lines, one in 6,000 would be further off
  Verdict verdict;
  Numbers numbers(2);
  const Medium* const states[] = {&medium};
  const Majorants majorants(states);
  const Bounds3 extent = extent_of(medium);
  for (int i = 0; i < kLines; ++i) {
    const Vec3 from = numbers.point_in(wider(extent)), to = numbers.point_in(extent);
    const float distance = length(to - from);
    const Ray ray{from, (to - from) / distance};
    double depth = 0;
    for (int step = 0; step < kSteps; ++step) {
      const float t = distance * (static_cast<float>(step) + 0.5f) / kSteps;
      depth += static_cast<double>(medium.at(ray.at(t)).sigma_t().g) * static_cast<double>(distance) / kSteps;
    }
    double sum = 0, squares = 0;
    for (int n = 0; n < kRays; ++n) {
      TentativeCollisions collisions(majorants, ray, 1, Palette::rgb());
      double left = 1;
      while (left > 0 && collisions.advance(distance, numbers))
        left *= std::max(0., 1 - static_cast<double>(medium.at(ray.at(collisions.distance())).sigma_t().g) /
                                     static_cast<double>(collisions.majorant()[1]));
      sum += left, squares += left * left;
    }
    const double mean = sum / kRays, error = std::sqrt(std::max(0., squares / kRays - mean * mean) / kRays);
    const double expected = std::exp(-depth);
    if (!(std::abs(mean - expected) <= kDeviations * error + 2e-3 * expected + 1e-6))
      verdict.fail(fmt::format("from {} to {}, {:.5g} +- {:.2g} of the light is left, but quadrature gives {:.5g}",
                               point_text(from), point_text(to), mean, error, expected));
  }
  if (verdict.passed) verdict.message = fmt::format("{} lines", kLines);
  return verdict;
}

Verdict check_medium(const std::string& words, const std::string& place) {
  const auto medium = medium_of(words, place);
  Verdict all;
  for (const auto& check : {is_sound, keeps_to_bounds, lets_light_through}) {
    const Verdict verdict = check(*medium);
    if (!verdict.passed) all.fail(verdict.message);
    all.message += all.passed ? (all.message.empty() ? "" : ", ") + verdict.message : "";
  }
  return all;
}

}  // namespace dspm::test
