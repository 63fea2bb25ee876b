// "alpha" of shapes: which texture of Looks it is, and what it makes of a shape.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/shapes/shape.h"
#include "dspm/world/objects/looks.h"

namespace dspm {

struct WorldShape;

ParamList without_alpha(const ParamList& params);

class Alphas {
 public:
  Alphas(const SceneDescription& description, Looks& looks, Diagnostics& diagnostics)
      : description_(description), looks_(looks), diagnostics_(diagnostics) {}

  /// Returns a number of Looks; -1 if there is none.
  int of(const ShapeUse& use);
  /// Sets what the shape says of its holes, for that number in that state.
  void set(WorldShape& shape, int alpha, int state) const;

 private:
  const SceneDescription& description_;
  Looks& looks_;
  Diagnostics& diagnostics_;
};

}  // namespace dspm
