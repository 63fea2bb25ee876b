// The water of gallery/pool.dsc: pool.01.ply to .08.ply, two seconds that begin again where they end. Metres; the middle
// of the pool's floor is the origin, y is up. Ripples of all directions on deep water, omega^2 = g k [Lamb, Hydrodynamics,
// 6th ed., 229], each rounded to whole swings in the two seconds. All have the same curvature, so that long and short
// ones bundle light alike.
#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"
#include "scenes/generator/water_body.h"

namespace dspm {
namespace {

constexpr int kFrames = 8, kColumns = 121, kRows = 181, kRipples = 48;
constexpr float kSeconds = 2;
constexpr float kWidth = 4, kLength = 6, kDepth = 1.3f, kInStone = 0.03f;
constexpr float kShortest = 0.35f, kLongest = 1.6f;  // wavelengths in metres
constexpr float kCurvature = 0.3f;                   // 1/m, of each ripple's crest
constexpr float kGravity = 9.81f;

struct Ripple {
  Vec2 wave;  // 1/m, in the direction in which it runs
  float amplitude, swing, phase;
};

std::vector<Ripple> ripples() {
  std::vector<Ripple> list;
  for (int i = 0; i < kRipples; ++i) {
    const PathRandom random(0, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 u = random.pair(0, 0);
    const float part = (static_cast<float>(i) + u.x) / kRipples, angle = 2 * kPi * u.y;
    const float k = 2 * kPi / (kLongest * std::pow(kShortest / kLongest, part));
    const float swings = std::round(std::sqrt(kGravity * k) * kSeconds / (2 * kPi));
    list.push_back({Vec2{std::cos(angle), std::sin(angle)} * k, kCurvature / (k * k), 2 * kPi * swings / kSeconds,
                    2 * kPi * random.pair(1, 0).x});
  }
  return list;
}

MeshData pool(const std::vector<Ripple>& all, float time) {
  std::vector<Vec3> points, normals;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const float x = (static_cast<float>(i) / (kColumns - 1) - 0.5f) * (kWidth + 2 * kInStone);
      const float z = (static_cast<float>(j) / (kRows - 1) - 0.5f) * (kLength + 2 * kInStone);
      float height = 0;
      Vec2 slope{0, 0};
      for (const Ripple& each : all) {
        const float angle = each.wave.x * x + each.wave.y * z - each.swing * time + each.phase;
        height += each.amplitude * std::cos(angle);
        slope = slope + each.wave * (-each.amplitude * std::sin(angle));
      }
      points.push_back({x, kDepth + height, z});
      normals.push_back(normalize(Vec3{-slope.x, 1, -slope.y}));
    }
  return water_body(std::move(points), std::move(normals), kColumns, -kInStone);
}

}  // namespace

void make_pool(const std::filesystem::path& directory) {
  const std::vector<Ripple> all = ripples();
  for (int frame = 0; frame < kFrames; ++frame)
    write_ply(directory / fmt::format("pool.{:02}.ply", frame + 1),
              pool(all, kSeconds * static_cast<float>(frame) / kFrames));
}

}  // namespace dspm
