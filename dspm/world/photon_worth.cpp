#include "dspm/world/photon_worth.h"

#include <cmath>

#include "dspm/math/frames.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// By frame: around what is in it; the file's sphere if it is empty.
std::vector<BoundingSphere> spheres(const Geometry& geometry, const BoundingSphere& of_file, int frames) {
  std::vector<Bounds3> bounds(static_cast<std::size_t>(frames));
  for (const WorldShape& shape : geometry.shapes()) {
    Bounds3 of_shape;
    for (int i = 0; i < shape.placed.shape->primitive_count(); ++i) of_shape.add(shape.placed.bounds(i));
    for (std::size_t f = 0; f < bounds.size(); ++f)
      if (shape.present[f]) bounds[f].add(of_shape);
  }
  std::vector<BoundingSphere> all;
  for (const Bounds3& box : bounds) all.push_back(box.empty() ? of_file : sphere_around(box));
  return all;
}

/// Of a light's state. If it is infinitely far, its power is what falls on the file's whole sphere.
struct Power {
  double power;
  bool infinitely_far;
};

std::vector<Power> powers(const WorldLight& light, const Vec3& center) {
  std::vector<Power> all;
  for (const auto& state : light.states.states) {
    const auto seen = state->illuminate(center, {0.5f, 0.5f});
    all.push_back({static_cast<double>(luminance(state->power())), seen && std::isinf(seen->distance)});
  }
  return all;
}

}  // namespace

// n paths, of which a fraction p_i starts at light i of power P_i, give the flux of light i as n p_i photons of P_i /
// (n p_i) each: a variance in proportion to P_i^2 / p_i, and to the sum of that for all lights. In a file of its own
// p_i is P_i / P, P the sum of all P_i, which makes the sum P^2, the minimum.
std::vector<PhotonWorth> photon_worth(const Geometry& geometry, const std::vector<WorldLight>& lights,
                                      const BoundingSphere& sphere, int frames) {
  std::vector<std::vector<Power>> of_states;
  for (const WorldLight& light : lights) of_states.push_back(powers(light, sphere.center));
  const std::vector<BoundingSphere> own = spheres(geometry, sphere, frames);
  std::vector<PhotonWorth> worth(static_cast<std::size_t>(frames));
  for (FileFrame f(0); f.index() < frames; ++f) {
    PhotonWorth& of_frame = worth[f.slot()];
    const double radius = static_cast<double>(own[f.slot()].radius) / static_cast<double>(sphere.radius);
    double flux = 0, variance = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const int state = lights[i].states.at(f);
      if (state < 0) continue;
      Power there = of_states[i][static_cast<std::size_t>(state)];
      if (!(there.power > 0)) continue;
      if (there.infinitely_far) of_frame.by_reach = radius * radius, there.power *= radius * radius;
      flux += there.power, variance += there.power * there.power / static_cast<double>(lights[i].photon_probability);
    }
    if (variance > 0) of_frame.by_choice = flux * flux / variance;
  }
  return worth;
}

}  // namespace dspm
