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
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class FbmTexture final : public Texture<T> {
 public:
  FbmTexture(const Octaves& octaves, const Transform& world_from_texture)
      : octaves_(octaves), world_from_texture_(world_from_texture) {}

  T evaluate(const TexturePoint& at) const override { return T(fbm(world_from_texture_.inverse_point(at.p), octaves_)); }

 private:
  Octaves octaves_;
  Transform world_from_texture_;
};

}  // namespace

template <class T>
TexturePtr<T> make_fbm(ParamReader& reader, const TextureContext& context) {
  const Octaves octaves = Octaves::read(reader);
  reader.finish();
  return std::make_shared<FbmTexture<T>>(octaves, context.world_from_texture);
}

template TexturePtr<float> make_fbm<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_fbm<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
