// The formulas that a GPU shares with the CPU, each called once by a kernel. formulas.sh compiles this file for devices, for
// which nothing but constexpr functions may be called.
#include "words.h"

#include <cstdint>
#include <span>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/bins.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/microfacet.h"
#include "dspm/media/beers_law.h"
#include "dspm/media/henyey_greenstein.h"
#include "dspm/shapes/triangle.h"

namespace dspm {

constexpr float of_one_number(float x) {
  const rounded::SinCos around = rounded::sin_cos(x);
  return around.sin + around.cos + rounded::tan(x) + rounded::asin(x) + rounded::acos(x) + rounded::atan(x) +
         rounded::exp(x) + rounded::log(x) + rounded::log2(x) + rounded::log1p(x) + rounded::cbrt(x) + rounded::sqrt(x);
}

constexpr float of_two_numbers(Vec2 u) {
  return rounded::pow(u.x, u.y) + rounded::hypot(u.x, u.y) + rounded::atan2(u.y, u.x);
}

constexpr Vec3 warped(Vec2 u) {
  const Vec2 disk = concentric_disk(u), triangle = uniform_triangle(u);
  const Vec2 numbers = concentric_disk_numbers(disk) + uniform_triangle_numbers(triangle);
  const Vec3 w = uniform_sphere(u);
  const Vec2 back = uniform_sphere_numbers(w) + numbers;
  return cosine_hemisphere(u) + uniform_hemisphere(u) + uniform_cone(u, 0.25f) +
         Basis::around(w).to_world({back.x, back.y, 1});
}

constexpr Spectrum scattered(const Vec3& wo, Vec2 u, const Spectrum& eta, const Spectrum& k) {
  const Ggx facets({0.3f, 0.2f});
  const Vec3 m = facets.sample_visible(wo, u.x, u.y), wi = reflect(wo, m);
  const Vec3 beyond = refract(wo, m, 1.5f).value_or(wi);
  const HenyeyGreenstein phase(0.5f);
  const Spectrum mirrored = fresnel_conductor(dot(wo, m), eta, k) * facets.reflection(wo, wi, m);
  return (mirrored + fresnel_schlick(eta, u.x) * fresnel_dielectric(u.y, 1.5f)) *
             phase.pdf_w(wo, phase.sample(beyond, u)) +
         left_after(k, u.x) * facets.reflection_density(wo, m);
}

/// Returns the distance of a placed triangle, or infinity.
constexpr float met(const Transform& place, const Ray& ray, const Vec3* corners) {
  const TriangleRay prepared(place.inverse_ray(ray));
  const auto hit = intersect(prepared, corners[0], corners[1], corners[2], ray.t_max);
  return hit ? hit->t : kInfinity;
}

struct Input {
  Transform place;
  Ray ray;
  Vec3 corners[3];
  Spectrum eta, k;
  std::uint64_t seed, frames;
  const Bin* bins;
  const std::uint32_t* cutpoints;
  std::uint32_t bin_count;
};
struct Output {
  Vec3 direction;
  Spectrum light;
  Rgb colour;
  float number;
};

}  // namespace dspm

extern "C" __global__ void formulas(const dspm::Input* input, dspm::Output* output) {
  using namespace dspm;
  const Input& in = *input;
  const PathRandom random = PathRandom::even(in.seed, Stream::photon, in.seed, 3);
  const Vec2 u = random.pair(0, 1);
  float frames = static_cast<float>(FrameSet(in.frames).count());
  FrameSet(in.frames).for_each([&](Frame f) { frames += static_cast<float>(f); });
  const std::span<const Bin> bins(in.bins, in.bin_count + 1);
  const BinChoice choice =
      choose_bin(bins, std::span<const std::uint32_t>(in.cutpoints, cutpoint_count(in.bin_count)), random.number(1, 2));
  output->direction = warped(u);
  output->light = scattered(in.ray.direction, u, in.eta, in.k);
  output->colour = Rgb(of_one_number(u.x), of_two_numbers(u), luminance(Rgb(u.y)));
  output->number = met(in.place, in.ray, in.corners) + frames + choice.rest;
}
