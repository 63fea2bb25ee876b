// The tree of lamps chooses with the probabilities that it tells, which follow what lamps send to a point.
#include "dspm/lights/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dspm/base/math/sampling.h"
#include "tests/lights/random.h"

namespace dspm {
namespace {

using namespace dspm::test;

Vec3 point_in(Sequence& random, const Vec3& size) {
  const Vec2 a = random.pair(), b = random.pair();
  return Vec3{a.x, a.y, b.x} * size;
}

/// Points, spots, and flat lamps with one or two sides, over a street.
std::vector<LightTree::Lamp> street(int count) {
  Sequence random(5);
  std::vector<LightTree::Lamp> lamps;
  for (int i = 0; i < count; ++i) {
    LightBounds bounds;
    const Vec3 p = point_in(random, {4, 100, 1}), w = uniform_sphere(random.pair());
    bounds.box = {p, p};
    if (i % 4 != 0) bounds.axis = w, bounds.spread = 0;
    if (i % 4 == 1) bounds.spread = 0.3f, bounds.reach = 0.1f;
    if (i % 4 > 1) bounds.box.high = p + Vec3{0.1f, 0.2f, 0}, bounds.two_sided = i % 4 == 2;
    lamps.push_back({bounds, static_cast<double>(1 + i % 7)});
  }
  return lamps;
}

std::vector<LightReceiver> receivers() {
  Sequence random(6);
  std::vector<LightReceiver> all;
  for (int i = 0; i < 20; ++i) {
    const Vec3 p = point_in(random, {5, 120, 2}) - Vec3{0, 10, 1};
    all.push_back({p, i % 3 == 0 ? Vec3{} : uniform_sphere(random.pair())});
  }
  return all;
}

TEST(LightTree, ProbabilitiesAddUpTo1) {
  for (const int count : {1, 2, 3, 10, 1000}) {
    auto lamps = street(count);
    if (count > 2) lamps[1].power = 0;
    const LightTree tree(lamps);
    for (const LightReceiver& at : receivers()) {
      double sum = 0;
      for (int i = 0; i < count; ++i) sum += static_cast<double>(tree.probability(at, i));
      EXPECT_NEAR(sum, 1, 1e-5) << count;
      EXPECT_TRUE(count <= 2 || tree.probability(at, 1) == 0);
    }
  }
}

// Of numbers in even steps, each sample falls into a lamp's part of [0, 1) as often as the part is long, but for those at
// its ends.
TEST(LightTree, ChoosesAsOftenAsItSays) {
  constexpr int kNumbers = 4000;
  for (const int count : {1, 3, 40})
    for (const int samples : {1, 8}) {
      const LightTree tree(street(count));
      for (const LightReceiver& at : receivers()) {
        std::vector<int> chosen(static_cast<std::size_t>(count));
        for (int i = 0; i < kNumbers; ++i) {
          int all = 0;
          tree.choose(at, samples, (i + 0.5) / kNumbers, [&](int lamp, float probability, int here, float within) {
            EXPECT_EQ(probability, tree.probability(at, lamp));
            EXPECT_GE(within, 0);
            EXPECT_LT(within, 1);
            chosen[static_cast<std::size_t>(lamp)] += here, all += here;
          });
          ASSERT_EQ(all, samples);
        }
        for (int i = 0; i < count; ++i)
          EXPECT_NEAR(chosen[static_cast<std::size_t>(i)],
                      static_cast<double>(tree.probability(at, i)) * samples * kNumbers, samples + 1);
      }
    }
}

// One number chooses, and what is left of it is uniform again: nearby numbers stay nearby.
TEST(LightTree, KeepsStrata) {
  const LightTree tree(street(20));
  const LightReceiver at = receivers().front();
  std::vector<int> order;
  float last = -1;
  for (int i = 0; i < 100'000; ++i)
    tree.choose(at, 1, (i + 0.5) / 100'000, [&](int lamp, float, int, float within) {
      if (order.empty() || order.back() != lamp) {
        order.push_back(lamp);
      } else {
        EXPECT_GT(within, last);
      }
      last = within;
    });
  std::sort(order.begin(), order.end());
  EXPECT_EQ(std::unique(order.begin(), order.end()), order.end()) << "a lamp has two parts";
}

TEST(LightTree, VisitsFewNodesOfMany) {
  const auto visits = [](int count) {
    const LightTree tree(street(count));
    int sum = 0;
    for (const LightReceiver& at : receivers()) sum += tree.choose(at, 8, 0.3, [](int, float, int, float) {});
    return sum;
  };
  const int of_thousand = visits(1000), of_many = visits(30'000);
  EXPECT_LT(of_thousand, 8 * 10 * static_cast<int>(receivers().size())) << "a way down for each sample";
  EXPECT_LT(of_many, 2 * of_thousand);
}

/// What a small lamp sends to a receiver, over the sum of all lamps.
std::vector<double> exact_shares(const std::vector<LightTree::Lamp>& lamps, const LightReceiver& at) {
  std::vector<double> shares;
  double sum = 0;
  for (const LightTree::Lamp& lamp : lamps) {
    const Vec3 d = at.p - lamp.bounds.box.center();
    const float to_axis = std::acos(std::clamp(dot(normalize(d), lamp.bounds.axis), -1.f, 1.f));
    const float beyond = std::max(0.f, to_axis - lamp.bounds.spread);
    const double cosine = beyond < lamp.bounds.reach ? std::cos(static_cast<double>(beyond)) : 0;
    const double facing = at.n == Vec3{} ? 1 : std::abs(static_cast<double>(dot(at.n, normalize(d))));
    shares.push_back(lamp.power / lamp.bounds.solid_angle() * cosine * facing / static_cast<double>(length2(d)));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

// The second moment of the estimate of what all lamps send, by one sample: 1 if lamps were chosen exactly. By power, it
// is the mean of the squares over the share of power. Lamps that face anywhere are a hard case.
TEST(LightTree, IsFarBetterThanPower) {
  auto lamps = street(1000);
  std::erase_if(lamps, [](const LightTree::Lamp& lamp) { return lamp.bounds.two_sided; });
  const LightTree tree(lamps);
  double all_power = 0, by_tree = 0, by_power = 0;
  for (const LightTree::Lamp& lamp : lamps) all_power += lamp.power;
  for (const LightReceiver& at : receivers()) {
    const std::vector<double> exact = exact_shares(lamps, at);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      if (!(exact[i] > 0)) continue;
      by_tree += exact[i] * exact[i] / static_cast<double>(tree.probability(at, static_cast<int>(i)));
      by_power += exact[i] * exact[i] * all_power / lamps[i].power;
    }
  }
  EXPECT_LT(by_tree, 0.2 * by_power);
}

// The integral of the cosine to the nearest normal, by uniform directions.
TEST(LightBounds, SolidAngleIsAnIntegral) {
  for (const bool two_sided : {false, true})
    for (const float spread : {0.f, 0.4f, 1.5f, 2.5f, kPi})
      for (const float reach : {0.05f, 0.7f, kPi / 2}) {
        if (two_sided && spread + reach > kPi / 2) continue;
        LightBounds bounds;
        bounds.spread = spread, bounds.reach = reach, bounds.two_sided = two_sided;
        double sum = 0;
        constexpr int kSteps = 20'000;
        for (int i = 0; i < kSteps; ++i) {
          const double angle = std::acos(1 - 2 * (i + 0.5) / kSteps);
          const double beyond = std::max(0., angle - static_cast<double>(spread));
          sum += beyond < static_cast<double>(reach) ? std::cos(beyond) : 0;
        }
        EXPECT_NEAR(bounds.solid_angle(), (two_sided ? 2 : 1) * sum * 4 * M_PI / kSteps, 2e-3)
            << spread << " " << reach;
      }
}

TEST(LightBounds, HoldAllThatIsAdded) {
  Sequence random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<LightBounds> parts;
    const float most = i % 2 == 0 ? 0.3f : kPi;
    for (int k = 0; k < 4; ++k) {
      LightBounds part;
      const Vec3 p = point_in(random, {1, 1, 1});
      part.box = {p, p + point_in(random, {1, 1, 1})}, part.axis = uniform_sphere(random.pair());
      if (i % 3 == 0) part.axis = normalize(part.axis * 0.1f + Vec3{1, 0, 0});
      part.spread = most * random.pair().x, part.reach = random.pair().x;
      parts.push_back(part);
    }
    LightBounds all = parts[0];
    for (const LightBounds& part : parts) all.add(part);
    for (const LightBounds& part : parts) {
      const float between = std::acos(std::clamp(dot(part.axis, all.axis), -1.f, 1.f));
      EXPECT_LE(std::min(between + part.spread, kPi), all.spread + 2e-3f);
      EXPECT_GE(all.reach, part.reach);
      EXPECT_EQ(min(all.box.low, part.box.low), all.box.low);
      EXPECT_EQ(max(all.box.high, part.box.high), all.box.high);
    }
  }
}

}  // namespace
}  // namespace dspm
