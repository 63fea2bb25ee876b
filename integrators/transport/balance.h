// Two ways to find a light, a shadow ray from a surface and a ray that is scattered there and hits it, combined by the
// balance heuristic. [Veach 1997, 9.2]
#pragma once

#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the weight of the way with density `own` if the other has density `other`.
inline float balance(float own, float other) { return own > 0 ? own / (own + other) : 0; }

/// Returns the weight of a light that the path hits at `vertex`.
inline float weight_of_hit(const Scene& scene, const CameraPath& path, const Vertex& vertex, const Light& light) {
  if (path.pdf_w == 0) return 1;
  const float samples =
      light_samples(scene, scene.lights[static_cast<std::size_t>(vertex.shape.light)], path.departure());
  return balance(path.pdf_w, samples * light.pdf_w(path.from, vertex.point, vertex.hit.primitive));
}

/// Returns the weight of an infinite light that the path meets as it leaves the scene.
inline float weight_of_escape(const Scene& scene, const CameraPath& path, const SceneLight& scene_light,
                              const Light& light) {
  if (path.pdf_w == 0) return 1;
  return balance(path.pdf_w, light_samples(scene, scene_light, path.departure()) * light.escaped_pdf_w(path.ray));
}

}  // namespace dspm
