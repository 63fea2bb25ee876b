// Noise with creases, as on orange peel, crumpled cloth and rock: fbm's octaves, each folded up to its absolute value.
//
//   Texture "peel" "float" "wrinkled" "integer octaves" 5 "float roughness" .6
//
//   | octaves   | 8  | how many sizes of noise are added up; each is about half the last |
//   | roughness | .5 | the strength of each octave over that of the last                 |
//
// 0 or more, about 0.4 on average. The largest waves are about a unit long in the texture's own space. See noise.h.
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/noise_texture.h"
#include "dspm/textures/octaves.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
template <class T>
TexturePtr<T> make_wrinkled(ParamReader& reader, const TextureContext& context) {
  const Octaves octaves = read_octaves(reader);
  reader.finish();
  return std::make_shared<NoiseTexture<T>>(PlainNoise{PlainNoise::Kind::wrinkled, octaves, context.world_from_texture});
}

template TexturePtr<float> make_wrinkled<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_wrinkled<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
