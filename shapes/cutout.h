// A cutout says where a shape has holes: pbrt's "alpha". Shapes know no textures, so world implements this with one.
#pragma once

#include "dspm/base/params/params.h"

namespace dspm {

struct SurfacePoint;

class Cutout {
 public:
  virtual ~Cutout() = default;
  /// The fraction of rays that the surface stops at a point of the world: all of them from 1 on, none up to 0.
  virtual float alpha(const SurfacePoint& point) const = 0;
};

inline constexpr const char* kAlphaParam = "alpha";

/// Reads "alpha" of any shape, for any plugin. Call it before the shape's own factory reads the rest.
inline ValueOrTexture<float> read_alpha(ParamReader& params) {
  return params.number_or_texture(kAlphaParam, 1, "", "the fraction of rays that the surface stops; 0: a hole");
}

}  // namespace dspm
