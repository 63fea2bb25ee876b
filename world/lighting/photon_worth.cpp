#include "dspm/world/lighting/photon_worth.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// Returns the sphere around what is in each frame; the file's sphere if the frame is empty.
std::vector<BoundingSphere> spheres(const Geometry& geometry, const BoundingSphere& of_file, int frames) {
  std::vector<Bounds3> bounds(static_cast<std::size_t>(frames));
  for (const WorldShape& shape : geometry.shapes()) {
    Bounds3 of_shape;
    for (int i = 0; i < shape.placed.shape->primitive_count(); ++i) of_shape.add(shape.placed.bounds(i));
    shape.present.for_each([&](FileFrame f) { bounds[f.slot()].add(of_shape); });
  }
  std::vector<BoundingSphere> all;
  for (const Bounds3& box : bounds) all.push_back(box.empty() ? of_file : sphere_around(box));
  return all;
}

/// Returns whether the light is infinitely far away. Its power is then what falls on the file's whole sphere.
bool is_infinitely_far(const WorldLight& light, const Vec3& center) {
  const auto& states = light.states.states;
  return std::any_of(states.begin(), states.end(), [&](const std::shared_ptr<const Light>& state) {
    const auto seen = state->illuminate(center, {0.5f, 0.5f});
    return seen && std::isinf(seen->distance);
  });
}

}  // namespace

std::vector<PhotonWorth> photon_worth(const Geometry& geometry, const std::vector<WorldLight>& lights,
                                      const LightChoices& choices, const BoundingSphere& sphere) {
  std::vector<bool> far;
  for (const WorldLight& light : lights) far.push_back(is_infinitely_far(light, sphere.center));
  const auto frames = static_cast<int>(choices.of_frame.size());
  const std::vector<BoundingSphere> own = spheres(geometry, sphere, frames);
  std::vector<PhotonWorth> worth(choices.of_frame.size());
  for (FileFrame f(0); f.index() < frames; ++f) {
    PhotonWorth& of_frame = worth[f.slot()];
    const double radius = static_cast<double>(own[f.slot()].radius) / static_cast<double>(sphere.radius);
    std::vector<double> powers;  // what enters the frame's own sphere
    for (std::size_t i = 0; i < lights.size(); ++i) {
      powers.push_back(lights[i].power(f) * (far[i] ? radius * radius : 1));
      if (far[i] && powers[i] > 0) of_frame.by_reach = radius * radius;
    }
    of_frame.by_choice =
        worth_of_choice(powers, choices.probabilities[static_cast<std::size_t>(choices.of_frame[f.slot()])]);
  }
  return worth;
}

}  // namespace dspm
