// Noise of several sizes, as on clouds, rust and stained walls; about 0, mostly within -0.5 .. 0.5.
//
//   Texture "stains" "float" "fbm" "integer octaves" 6 "float roughness" .5
//
//   | octaves   | 8  | how many sizes of noise are added up; each is about half the last |
//   | roughness | .5 | the strength of each octave over that of the last                 |
//
// The largest waves are about a unit long in the texture's own space, the transform in force where it was defined: a
// Scale before it enlarges them. See noise.h.
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/noise_texture.h"
#include "dspm/textures/octaves.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
template <class T>
TexturePtr<T> make_fbm(ParamReader& reader, const TextureContext& context) {
  const Octaves octaves = read_octaves(reader);
  reader.finish();
  return std::make_shared<NoiseTexture<T>>(PlainNoise{PlainNoise::Kind::fbm, octaves, context.world_from_texture});
}

template TexturePtr<float> make_fbm<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_fbm<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
