// A picture of one frame that owes nothing to integrators/: written from the rendering equation in its path form, slow,
// and without any art. A path's contribution to a pixel is
//
//   Le G V f |cos| ... f W_e,   f(x, to the eye <- from the light) as it scatters radiance,
//
// and paths are drawn from the light on. Rough lobes are weighed by `Bsdf::evaluate`, along directions half of which come from
// the cosine about the geometric normal and half from the lobes themselves; only specular ones are taken at their word.
// Every vertex on a rough lobe is connected to the camera. No roulette, lights chosen evenly, numbers of its own.
//
// Lights themselves, and what the camera sees by way of specular lobes, are left out.
#pragma once

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "dspm/base/math/sampling.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/world/scene/scene.h"

namespace dspm::test {

class LightTracer {
 public:
  /// Paths scatter at most max_depth times. The scene's pixel filter is taken to be the box of one pixel.
  LightTracer(const Scene& scene, int width, int height, int max_depth)
      : scene_(scene), camera_(*scene.camera.states.at(0).object), width_(width), height_(height), depth_(max_depth) {}

  Image picture(std::int64_t paths, std::uint64_t seed) const {
    constexpr std::int64_t kGrain = 1 << 16;
    std::vector<Sums> sums(static_cast<std::size_t>(chunk_count(paths, kGrain)));
    parallel_chunks(paths, kGrain, [&](std::int64_t begin, std::int64_t end) {
      const auto chunk = static_cast<std::size_t>(begin / kGrain);
      std::seed_seq numbers{seed, static_cast<std::uint64_t>(chunk)};
      Walk walk{std::mt19937_64(numbers), Sums(static_cast<std::size_t>(width_ * height_) * 3)};
      for (std::int64_t i = begin; i < end; ++i) trace(walk);
      sums[chunk] = std::move(walk.sums);
    });
    Image image(width_, height_);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const Sums& s : sums) sum += s[3 * i + c];
        image.pixels[i][static_cast<int>(c)] = static_cast<float>(sum / static_cast<double>(paths));
      }
    return image;
  }

 private:
  using Sums = std::vector<double>;  // by pixel, then channel

  struct Walk {
    std::mt19937_64 random;
    Sums sums;

    float number() { return static_cast<float>(random() >> 40) * 0x1p-24f; }
    Vec2 pair() {
      const float x = number();
      return {x, number()};
    }
  };

  /// Where flux arrives.
  struct Arrival {
    SurfacePoint point;
    Vec3 in;  // towards where it comes from
    Rgb flux;
  };

  void trace(Walk& walk) const {
    const auto lights = static_cast<float>(scene_.lights.size());
    const auto index = static_cast<std::size_t>(walk.number() * lights);
    const auto start = scene_.lights[index].states.states.at(0).object->emit(walk.pair(), walk.pair());
    if (!start) return;
    Ray ray = start->ray;
    Rgb flux = start->flux * lights;
    for (int scatterings = 1; scatterings <= depth_ && !is_black(flux); ++scatterings) {
      const RayHit hit = scene_.accel->partition(ray, scene_.frames())[0].hit;
      if (hit.missed()) return;
      const Arrival arrival{scene_.surface_point(hit, ray.direction), -ray.direction, flux};
      const auto material = static_cast<std::size_t>(scene_.shapes[static_cast<std::size_t>(hit.shape)].material);
      BsdfSlot slot;
      const Bsdf& bsdf = scene_.materials[material].states.at(0).object->bsdf(arrival.point, slot);
      const LobeSet rough = bsdf.lobes(1e-4f), specular = static_cast<LobeSet>(bsdf.all_lobes() & ~rough);
      if (rough != 0) connect(arrival, bsdf, rough, walk);
      const bool both = rough != 0 && specular != 0, mirrors = rough == 0 || (both && walk.number() < 0.5f);
      Vec3 out;
      flux = mirrors ? mirrored(arrival, bsdf, specular, walk, out) : scattered(arrival, bsdf, rough, walk, out);
      if (both) flux *= 2;
      ray = arrival.point.spawn(out);
    }
  }

  /// What f leaves of the flux for each unit of |cos(out, ng)| dw: flux is measured across the geometric normal, f's
  /// light across the shading normal.
  static Rgb density(const Arrival& at, const Bsdf& bsdf, LobeSet lobes, const Vec3& out) {
    const float cosine = std::abs(dot(at.in, at.point.ns) / dot(at.in, at.point.ng));
    return at.flux * Palette::rgb().seen(bsdf.evaluate(out, at.in, Transport::radiance, lobes)) * cosine;
  }

  void connect(const Arrival& at, const Bsdf& bsdf, LobeSet lobes, Walk& walk) const {
    const auto sight = camera_.sight(at.point.p, walk.pair());
    if (!sight) return;
    const float x = std::floor(sight->film.x), y = std::floor(sight->film.y);
    if (!(x >= 0 && x < static_cast<float>(width_) && y >= 0 && y < static_cast<float>(height_))) return;
    const float pixels = sight->pixels_per_area * std::abs(dot(sight->w, at.point.ng));
    const Rgb radiance = density(at, bsdf, lobes, sight->w) * pixels;
    if (is_black(radiance)) return;
    if (!scene_.accel->occluded(at.point.spawn(sight->w, sight->distance), scene_.frames()).empty()) return;
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < 3; ++c) walk.sums[3 * pixel + c] += static_cast<double>(radiance[static_cast<int>(c)]);
  }

  static Rgb scattered(const Arrival& at, const Bsdf& bsdf, LobeSet lobes, Walk& walk, Vec3& out) {
    const float front = dot(at.in, at.point.ng) > 0 ? 1.f : -1.f, sides = bsdf.transmits(lobes) ? 2.f : 1.f;
    if (walk.number() < 0.5f) {
      const float side = sides > 1 && walk.number() < 0.5f ? -front : front;
      out = normalize(Basis::around(at.point.ng * side).to_world(cosine_hemisphere(walk.pair())));
    } else {
      const auto sample = bsdf.sample(at.in, {walk.number(), walk.number(), walk.number()}, Transport::flux, lobes);
      if (!sample) return {};
      out = sample->wi;
    }
    const float cosine = dot(out, at.point.ng),
                by_cosine = sides > 1 || cosine * front > 0 ? std::abs(cosine) / (kPi * sides) : 0;
    const float pdf_w = 0.5f * (by_cosine + bsdf.pdf_w(at.in, out, Transport::flux, lobes));
    if (!(pdf_w > 0)) return {};  // along the surface
    return density(at, bsdf, lobes, out) * (std::abs(cosine) / pdf_w);
  }

  static Rgb mirrored(const Arrival& at, const Bsdf& bsdf, LobeSet lobes, Walk& walk, Vec3& out) {
    if (!(at.point.ns == at.point.ng)) throw std::logic_error("bent normals on a mirror are beyond this tracer");
    const auto sample = bsdf.sample(at.in, {walk.number(), walk.number(), walk.number()}, Transport::flux, lobes);
    if (!sample) return {};
    out = sample->wi;
    return at.flux * Palette::rgb().seen(sample->weight);
  }

  const Scene& scene_;
  const Camera& camera_;
  int width_, height_, depth_;
};

}  // namespace dspm::test
