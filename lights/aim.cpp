#include "dspm/lights/aim.h"

#include "dspm/base/math/vec.h"

namespace dspm {

Aim read_aim(ParamReader& reader) {
  const Vec3 from = reader.point("from", {0, 0, 0}, "light space", "the light shines from here ...");
  const Vec3 to = reader.point("to", {0, 0, 1}, "light space", "... towards this point");
  const Vec3 along = to - from;
  if (length(along) > 0) return {from, along};
  reader.error(reader.has("to") ? "to" : "from",
               "\"from\" and \"to\" of " + reader.subject() + " are the same point, so it has no direction");
  return {{0, 0, 0}, {0, 0, 1}};
}

}  // namespace dspm
