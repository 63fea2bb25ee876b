// The weights of vertex connection and merging: one path, found in every way, has weights that sum to 1, each of them
// its way's density over the sum of all.
#include "dspm/integrators/methods/vcm/subpath_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace dspm {
namespace subpath_weights_test {

enum class LightKind { area, infinite, point, parallel };

/// A path from the light, vertex 0, over surfaces 1 to `length` to the camera. Numbers are made up, but each density
/// has one value, whichever way asks for it.
struct MadeUpPath {
  struct Surface {
    float cosine_to_light, cosine_to_camera;    // of the segments there, to the normal
    float distance2;                            // from the vertex before, squared
    float pdf_to_camera = 0, pdf_to_light = 0;  // of scattering, by solid angle
    bool mirror = false;
  };
  LightKind kind;
  std::vector<Surface> surfaces;  // 0: the light, which has no segment before it
  float emission, next_event;     // light subpath's start by both of its numbers; a shadow ray's, by area or direction
  float camera_pdf_a;             // of the last surface, from the camera

  int length() const { return static_cast<int>(surfaces.size()) - 1; }
  const Surface& at(int i) const { return surfaces[static_cast<std::size_t>(i)]; }
  bool parallel() const { return kind == LightKind::infinite || kind == LightKind::parallel; }
  bool delta() const { return kind == LightKind::point || kind == LightKind::parallel; }
  float cosine_at_light() const { return delta() ? 0 : parallel() ? 1 : at(0).cosine_to_camera; }
  float distance2(int i) const { return i == 1 && parallel() ? 1 : at(i).distance2; }
};

MadeUpPath made_up(std::mt19937& random, LightKind kind, int length) {
  std::uniform_real_distribution<float> unit(0.05f, 1);
  std::lognormal_distribution<float> wide(0, 1.5f);
  MadeUpPath path{kind, {}, wide(random), wide(random), wide(random)};
  for (int i = 0; i <= length; ++i) {
    const bool mirror = i > 0 && unit(random) < 0.3f;
    path.surfaces.push_back({unit(random), unit(random), wide(random), wide(random), wide(random), mirror});
  }
  return path;
}

/// What merges at vertex i count, told by where light comes from.
float merging(const MadeUpPath& path, const VcmWays& ways, int i) {
  const bool narrow = i > 1 && (path.at(i - 1).mirror || path.at(i - 1).pdf_to_camera >= 1);
  return narrow || !ways.connecting ? ways.merging : 0;
}

/// The light subpath's sums at vertex i.
SubpathWeights from_light(const MadeUpPath& path, const VcmWays& ways, int i) {
  const auto& here = path.at(i);
  if (i == 1)
    return SubpathWeights::leaving_light(path.next_event, path.emission, path.cosine_at_light())
        .arrived(path.distance2(1), here.cosine_to_light);
  const auto& last = path.at(i - 1);
  const SubpathWeights before = from_light(path, ways, i - 1);
  const SubpathWeights left = last.mirror ? before.mirrored(last.cosine_to_camera)
                                          : before.light_scattered(ways, last.pdf_to_camera, last.pdf_to_light,
                                                                   last.cosine_to_camera, merging(path, ways, i - 1));
  return left.arrived(here.distance2, here.cosine_to_light);
}

/// The camera subpath's sums on leaving vertex i towards the light, and on arriving there.
SubpathWeights from_camera(const MadeUpPath& path, const VcmWays& ways, int i);
SubpathWeights leaving_from_camera(const MadeUpPath& path, const VcmWays& ways, int i) {
  const auto& last = path.at(i);
  const SubpathWeights before = from_camera(path, ways, i);
  return last.mirror ? before.mirrored(last.cosine_to_light)
                     : before.camera_scattered(ways, last.pdf_to_light, last.pdf_to_camera, last.cosine_to_light);
}
SubpathWeights from_camera(const MadeUpPath& path, const VcmWays& ways, int i) {
  if (i == path.length()) return SubpathWeights::at_first_vertex(ways, path.camera_pdf_a);
  return leaving_from_camera(path, ways, i + 1).arrived(path.at(i + 1).distance2, path.at(i).cosine_to_camera);
}

/// By area, of vertex i when vertex i - 1 scatters to it, and when vertex i + 1 does.
double pdf_from_light(const MadeUpPath& path, int i) {
  return static_cast<double>(path.at(i - 1).pdf_to_camera * path.at(i).cosine_to_light / path.at(i).distance2);
}
double pdf_from_camera(const MadeUpPath& path, int i) {
  return static_cast<double>(path.at(i + 1).pdf_to_light * path.at(i).cosine_to_camera / path.at(i + 1).distance2);
}

/// A way: the camera subpath holds vertices from `camera` on, the light subpath those up to `light`; both hold the one
/// that is merged. The density is relative to specular scattering in between, which is the same for all ways.
struct Way {
  double density;
  double weight;
};

std::vector<Way> ways_to_find(const MadeUpPath& path, const VcmWays& ways) {
  const int last = path.length();
  // Of the first i vertices from either end.
  std::vector<double> light(path.surfaces.size(), 0), camera(path.surfaces.size() + 1, 0);
  std::vector<bool> connectable(path.surfaces.size(), false);
  for (int i = 1; i <= last; ++i) connectable[static_cast<std::size_t>(i)] = !path.at(i).mirror;
  // Geometric factors stand for what specular scattering leaves undetermined.
  const auto scattered_to_camera = [&](int i) {
    return path.at(i - 1).mirror ? static_cast<double>(path.at(i).cosine_to_light / path.at(i).distance2)
                                 : pdf_from_light(path, i);
  };
  const auto scattered_to_light = [&](int i) {
    return path.at(i + 1).mirror ? static_cast<double>(path.at(i).cosine_to_camera / path.at(i + 1).distance2)
                                 : pdf_from_camera(path, i);
  };
  for (int i = 1; i <= last; ++i)
    light[static_cast<std::size_t>(i)] =
        i == 1 ? static_cast<double>(path.emission * path.at(1).cosine_to_light / path.distance2(1))
               : light[static_cast<std::size_t>(i) - 1] * scattered_to_camera(i);
  for (int i = last; i >= 1; --i)
    camera[static_cast<std::size_t>(i)] = i == last ? static_cast<double>(path.camera_pdf_a)
                                                    : camera[static_cast<std::size_t>(i) + 1] * scattered_to_light(i);
  std::vector<Way> found;
  const auto& first = path.at(1);
  const auto end_of_light = [&](int i, float pdf_a) {
    return SubpathEnd{from_light(path, ways, i), path.at(i).pdf_to_light, pdf_a, merging(path, ways, i)};
  };
  const auto end_of_camera = [&](int i, float pdf_a) {
    return SubpathEnd{from_camera(path, ways, i), path.at(i).pdf_to_camera, pdf_a, merging(path, ways, i)};
  };
  // The light's vertex, scattered to from vertex 1.
  const double cosine = static_cast<double>(path.cosine_at_light() / path.distance2(1));
  const bool mirror = first.mirror;
  if (!path.delta()) {
    const double pdf = mirror ? 1 : static_cast<double>(first.pdf_to_light);
    // On arriving at the light; at infinity, densities stay those by direction.
    const SubpathWeights left = leaving_from_camera(path, ways, 1);
    const SubpathWeights arrived = path.parallel() ? left : left.arrived(path.at(1).distance2, path.cosine_at_light());
    const double next_event = mirror ? 0 : static_cast<double>(path.next_event) / (pdf * cosine);
    found.push_back({camera[1] * pdf * cosine,
                     static_cast<double>(weight_of_hit(ways, static_cast<float>(next_event), path.emission, arrived))});
  }
  if (!mirror) {
    const double hit =
        path.delta() ? 0 : static_cast<double>(first.pdf_to_light) * cosine / static_cast<double>(path.next_event);
    const double emission = light[1] / static_cast<double>(path.next_event);
    found.push_back({camera[1] * static_cast<double>(path.next_event),
                     static_cast<double>(weight_of_next_event(ways, static_cast<float>(hit),
                                                              end_of_camera(1, static_cast<float>(emission))))});
  }
  for (int i = 1; i <= last; ++i) {
    if (path.at(i).mirror) continue;
    const auto at = static_cast<std::size_t>(i);
    if (merging(path, ways, i) > 0)
      found.push_back({light[at] * camera[at] * static_cast<double>(ways.merging),
                       static_cast<double>(weight_of_merging(ways, end_of_light(i, 0), end_of_camera(i, 0)))});
    if (ways.connecting && i < last && !path.at(i + 1).mirror)
      found.push_back(
          {light[at] * camera[at + 1], static_cast<double>(weight_of_connection(
                                           ways, end_of_light(i, static_cast<float>(pdf_from_camera(path, i))),
                                           end_of_camera(i + 1, static_cast<float>(pdf_from_light(path, i + 1)))))});
    if (ways.sighting > 0 && i == last)
      found.push_back(
          {light[at] * static_cast<double>(ways.sighting),
           static_cast<double>(weight_of_sighting(ways, end_of_light(i, path.camera_pdf_a / ways.sighting)))});
  }
  return found;
}

TEST(SubpathWeights, SumToOneAndAreSharesOfTheDensities) {
  std::mt19937 random(3);
  int paths = 0;
  for (const LightKind kind : {LightKind::area, LightKind::infinite, LightKind::point, LightKind::parallel})
    for (const VcmWays ways :
         {VcmWays{0.7f, 900, true}, VcmWays{3, 900, false}, VcmWays{0, 900, true}, VcmWays{0.2f, 0, true},
          VcmWays{0, 900, false}, VcmWays{5, 0, false}, VcmWays{0, 0, true}, VcmWays{0, 0, false}})
      for (int length = 1; length <= 6; ++length)
        for (int trial = 0; trial < 50; ++trial) {
          const MadeUpPath path = made_up(random, kind, length);
          const std::vector<Way> found = ways_to_find(path, ways);
          if (found.empty()) continue;  // specular all the way from a light that no ray hits
          double densities = 0, weights = 0;
          for (const Way& way : found) densities += way.density, weights += way.weight;
          EXPECT_NEAR(weights, 1, 1e-4) << "length " << length;
          for (const Way& way : found) EXPECT_NEAR(way.weight, way.density / densities, 1e-4);
          ++paths;
        }
  EXPECT_GT(paths, 8000);
}

}  // namespace subpath_weights_test
}  // namespace dspm
