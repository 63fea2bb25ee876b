// Light straight from light sources that media scatter along camera beams, by shadow rays.
//
// Points of a beam are drawn in two ways: where the medium scatters most towards the camera, and near a light, whose light falls
// off with the square of the distance, by the angle under which it sees the beam [Kulla and Fajardo 2012, Importance Sampling
// Techniques for Path Tracing in Participating Media, 4.1]. Light that both may find is shared out by their densities, with the
// balance heuristic [Veach 1997, 9.2].
#pragma once

#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class BeamLight {
 public:
  BeamLight(const Scene& scene, HitPointWriter& out) : scene_(scene), out_(out) {}

  /// Adds what a section of the path's segment scatters, by a shadow ray for each way.
  void add(const CameraPath& path, const MediumSection& section);

 private:
  const Scene& scene_;
  HitPointWriter& out_;
};

}  // namespace dspm
