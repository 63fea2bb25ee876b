// Waves under gusts of wind, as on a lake: meant for displacement.
//
//   Texture "waves" "float" "windy"
//
// It has no parameters: |fbm of three octaves at a tenth of the frequency| times fbm of six octaves. The waves are
// about a unit long in the texture's own space, and gusts ten. [Pharr, Jakob, Humphreys, Physically Based Rendering,
// 3rd edition, 10.6.5]
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/noise_texture.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
template <class T>
TexturePtr<T> make_windy(ParamReader& reader, const TextureContext& context) {
  reader.finish();
  return std::make_shared<NoiseTexture<T>>(PlainNoise{PlainNoise::Kind::windy, Octaves{}, context.world_from_texture});
}

template TexturePtr<float> make_windy<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_windy<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
