// One of the two faces of a placed shape's surface: the one that it shows to a ray. If light passes through a surface,
// the direction that it comes from does not tell whether it has come to this face or to another one close by.
#pragma once

#include <cstdint>

#include "dspm/base/math/vec.h"

namespace dspm {

class ShapeFace {
 public:
  constexpr ShapeFace() = default;
  /// The face that looks towards w; `ng` points outward.
  constexpr ShapeFace(int shape, const Vec3& ng, const Vec3& w) : number_(dot(w, ng) < 0 ? ~shape : shape) {}

  constexpr int shape() const { return number_ < 0 ? ~number_ : number_; }
  constexpr bool is_inner() const { return number_ < 0; }

 private:
  std::int32_t number_ = 0;  // the shape's; its complement for the inner face
};

}  // namespace dspm
