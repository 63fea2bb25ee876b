// Embree alone, robust, as it comes: what a ray costs there, to compare. Its own triangle test decides, so it answers almost
// as dspm's trees do, but not bit by bit.
#pragma once

#include <memory>
#include <span>

#include "dspm/accel/embree.h"
#include "dspm/base/math/ray.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

class BareEmbree {
 public:
  /// Meshes become Embree's triangles, whole spheres its spheres; other shapes are met by their own tests, in callbacks.
  /// `shapes` must outlive it. Throws std::runtime_error if Embree reports an error.
  explicit BareEmbree(std::span<const PlacedShape> shapes);

  /// The distance; infinity: nothing.
  float nearest(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  RTCRay prepared(const Ray& ray) const;

  float first_ = 0;  // nearer hits do not count: a ray that leaves one of Embree's spheres would meet it again
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace dspm
