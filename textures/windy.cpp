// Waves under gusts of wind, as on a lake: meant for displacement.
//
//   Texture "waves" "float" "windy"
//
// It has no parameters: |fbm of three octaves at a tenth of the frequency| times fbm of six octaves. The waves are
// about a unit long in the texture's own space, and gusts ten. [Pharr, Jakob, Humphreys, Physically Based Rendering,
// 3rd edition, 10.6.5]
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/noise.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

constexpr Octaves kGusts{3, 0.5f}, kWaves{6, 0.5f};

template <class T>
class WindyTexture final : public Texture<T> {
 public:
  explicit WindyTexture(const Transform& world_from_texture) : world_from_texture_(world_from_texture) {}

  T evaluate(const TexturePoint& at) const override {
    const Vec3 own = world_from_texture_.inverse_point(at.p);
    return T(std::abs(fbm(own * 0.1f, kGusts)) * fbm(own, kWaves));
  }

 private:
  Transform world_from_texture_;
};

}  // namespace

template <class T>
TexturePtr<T> make_windy(ParamReader& reader, const TextureContext& context) {
  reader.finish();
  return std::make_shared<WindyTexture<T>>(context.world_from_texture);
}

template TexturePtr<float> make_windy<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_windy<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
