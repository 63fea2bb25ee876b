// Where rays meet surfaces, row by row, each in frames that see the same scattering function.
#pragma once

#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/world/scene/scene.h"
#include "python/chunks.h"
#include "python/rays.h"

namespace dspm::python {

struct Surfaces {
  const Scene* scene = nullptr;
  std::vector<int> ray;  // which one met it
  std::vector<FrameSet> frames;
  std::vector<Vec3> wo;
  std::vector<int> material, object;
  std::vector<RayHit> hits;
  std::vector<SurfacePoint> points;
  std::vector<BsdfSlot> bsdfs;

  std::size_t size() const { return ray.size(); }
  Surfaces& operator+=(const Surfaces& o) {
    scene = o.scene != nullptr ? o.scene : scene;
    append(ray, o.ray), append(frames, o.frames), append(wo, o.wo), append(material, o.material);
    append(object, o.object), append(hits, o.hits), append(points, o.points), append(bsdfs, o.bsdfs);
    return *this;
  }
};

/// Directions that were drawn at surfaces, those that are not absorbed.
struct Scattered {
  Rays rays;  // their rows are surfaces
  std::vector<Rgb> weight;
  std::vector<float> pdf_w;
  std::vector<std::uint8_t> specular;

  Scattered& operator+=(const Scattered& o) {
    rays += o.rays;
    append(weight, o.weight), append(pdf_w, o.pdf_w), append(specular, o.specular);
    return *this;
  }
};

/// Samples of lights as seen from surfaces.
struct LightSamples {
  Rays rays;  // shadow rays; their rows are surfaces
  std::vector<Vec3> wi;
  std::vector<Rgb> weight;
  std::vector<float> pdf_w;
  std::vector<int> light;

  LightSamples& operator+=(const LightSamples& o) {
    rays += o.rays;
    append(wi, o.wi), append(weight, o.weight), append(pdf_w, o.pdf_w), append(light, o.light);
    return *this;
  }
};

}  // namespace dspm::python
