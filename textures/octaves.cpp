#include "dspm/textures/octaves.h"

namespace dspm {

Octaves read_octaves(ParamReader& reader) {
  constexpr int kMost = 64;
  Octaves octaves;
  octaves.count = reader.integer("octaves", 8, {}, "the number of sizes of noise that are added up");
  octaves.roughness = reader.number("roughness", 0.5f, {}, "the strength of each octave over that of the last");
  if (octaves.count < 0 || octaves.count > kMost) {
    reader.error("octaves", "the number of octaves must be from 0 to 64");
    octaves.count = 8;
  }
  return octaves;
}

}  // namespace dspm
