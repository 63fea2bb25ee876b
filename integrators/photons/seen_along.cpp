#include "dspm/integrators/photons/seen_along.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/balance.h"
#include "dspm/integrators/transport/direct_light.h"

namespace dspm {
namespace {

/// A camera path that comes along the sample finds the light by its own ray or by a shadow ray, with weights that add up
/// to the same for both. Its density is taken for the photon's.
float seen_at_once(const Scene& scene, const PhotonOrigin& from, const Vertex& vertex, const BsdfSample& sample) {
  if (sample.specular) return from.seen.radiance;
  if (from.light.is_delta) {
    const float fall_off = from.seen.has_place ? length2(vertex.point.p - from.start.ray.origin) : 1;
    return sample.pdf_w * from.seen.radiance / fall_off;
  }
  const float samples =
      light_samples(scene, from.light, receiver_at(vertex.point)) * pdf_w_of(from.state, from.start, vertex.point.p);
  return from.seen.radiance * balance(sample.pdf_w, samples);
}

}  // namespace

LightSeen light_seen(const Emission& emission) {
  const float cosine = length2(emission.normal) > 0 ? std::abs(dot(emission.normal, emission.ray.direction)) : 1;
  return {luminance(emission.flux) * emission.pdf.position * emission.pdf.direction / cosine,
          !emission.pdf.delta_direction};
}

float seen_along(const Scene& scene, const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex,
                 const BsdfSample& sample) {
  return (path.bounces == 0 ? seen_at_once(scene, from, vertex, sample) : path.seen) *
         std::min(1.f, scene.palette->luminance(sample.weight));
}

}  // namespace dspm
