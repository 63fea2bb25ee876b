#include "dspm/lights/strength.h"

namespace dspm {
namespace {

float read_scale(ParamReader& reader) {
  const float scale = reader.number("scale", 1, "", "multiplies the light");
  if (scale >= 0) return scale;
  reader.error("scale", "parameter \"scale\" of " + reader.subject() + " must not be negative");
  return 1;
}

}  // namespace

Strength read_power(ParamReader& reader) {
  const float scale = read_scale(reader);
  return {scale,
          reader.number("power", -1, "lm", "total luminous power, as if the colour had luminance 1; -1: not used")};
}

Strength read_illuminance(ParamReader& reader) {
  const float scale = read_scale(reader);
  return {scale, reader.number("illuminance", -1, "lx", "on a surface that faces the light; -1: not used")};
}

}  // namespace dspm
