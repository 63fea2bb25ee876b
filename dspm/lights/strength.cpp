#include "dspm/lights/strength.h"

namespace dspm {
namespace {

float read_scale(ParamReader& reader) {
  const float scale = reader.number("scale", 1, "", "multiplies the light");
  if (scale >= 0) return scale;
  reader.error("scale", "parameter \"scale\" of " + reader.subject() + " must not be below 0");
  return 1;
}

}  // namespace

Strength read_power(ParamReader& reader) {
  const float scale = read_scale(reader);
  return {scale, reader.number("power", -1, "lm", "whole luminous power at luminance 1 of the colour; -1: not used")};
}

Strength read_illuminance(ParamReader& reader) {
  const float scale = read_scale(reader);
  return {scale, reader.number("illuminance", -1, "lx", "on a surface that faces the light; -1: not used")};
}

}  // namespace dspm
