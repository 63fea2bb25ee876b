// Where a shape of a directive, or of an instance, is at a moment.
#pragma once

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/lang/description.h"

namespace dspm {

/// `instance` is null if the shape is no instance's. All zeros if there is no such place.
inline Matrix4 matrix_at(Moment moment, const ShapeUse& use, const ObjectUse* instance) {
  const Matrix4 own = use.world_from_object.at(moment);
  return instance != nullptr ? instance->world_from_instance.at(moment) * own : own;
}

inline bool moves(const ShapeUse& use, const ObjectUse* instance) {
  return use.world_from_object.is_keyed() || (instance != nullptr && instance->world_from_instance.is_keyed());
}

/// Returns whether it goes on while the shutter is open: if neither the shape nor the instance is said not to.
inline bool blurs(const ShapeUse& use, const ObjectUse* instance) {
  return use.blurs && (instance == nullptr || instance->blurs);
}

}  // namespace dspm
