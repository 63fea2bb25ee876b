#include "dspm/testing/furnace.h"

#include <fmt/format.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/scattering.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/scene/scene.h"

namespace dspm::test {
namespace {

/// Returns the radiance that each pixel must have under a sky of radiance 1: the mean albedo of what it sees.
Image albedos(const Scene& scene, int width, int height, std::uint64_t seed) {
  constexpr int kRays = 16, kSamples = 16;
  Image image(width, height);
  const Camera& camera = *scene.camera.states[0].object;
  for (int pixel = 0; pixel < width * height; ++pixel)
    for (int n = 0; n < kRays; ++n) {
      const PathRandom random(seed, Stream::setup, static_cast<std::uint64_t>(pixel), static_cast<std::uint64_t>(n));
      const Vec2 offset = random.pair(kSamples, 0);
      const Vec2 film{static_cast<float>(pixel % width) + offset.x, static_cast<float>(pixel / width) + offset.y};
      const Ray ray = camera.ray(film, {0.5f, 0.5f});
      const RayHit hit = (*scene.accel->partition(ray, scene.frames()).begin()).hit;
      SurfacePoint point = scene.surface_point(hit, ray.direction);
      point.palette = scene.palette.get();
      const int material = scene.shapes[static_cast<std::size_t>(hit.shape)].material;
      BsdfSlot slot;
      const Bsdf& bsdf = scene.materials[static_cast<std::size_t>(material)].states[0].object->bsdf(point, slot);
      image.pixels[static_cast<std::size_t>(pixel)] +=
          scene.palette->seen(albedo(bsdf, -ray.direction, Transport::radiance, random, kSamples).mean) / kRays;
    }
  return image;
}

}  // namespace

Verdict check_furnace(const std::string& integrator, int iterations, const Tolerance& tolerance) {
  Verdict all;
  for (const float albedo : {0.f, 0.5f, 0.8f}) {
    const Verdict verdict =
        agreement(rendered(furnace(integrator, albedo), iterations), Rgb(1 / (1 - albedo)), tolerance);
    if (!verdict.passed) all.fail(fmt::format("albedo {}: {}", albedo, verdict.message));
  }
  return all;
}

Verdict check_open_furnace(const std::string& material, const std::string& integrator, int iterations,
                           const Tolerance& tolerance) {
  const std::string text = open_furnace(integrator, material);
  const TestScene furnace(text);
  const auto scene = furnace.scene({FileFrame(0)});
  const RenderSettings& settings = furnace.job().settings;
  std::vector<std::vector<Image>> expected;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
    expected.push_back({albedos(*scene, settings.width, settings.height, seed)});
  return agreement(rendered(text, iterations), tiles_of(expected), tolerance);
}

}  // namespace dspm::test
