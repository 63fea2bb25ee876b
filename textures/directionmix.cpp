// A blend of two textures by the direction that the surface faces: snow on the roofs, moss in the north.
//
//   Texture "slopes" "spectrum" "directionmix" "rgb tex1" [.9 .9 .9] "texture tex2" "rock" "vector3 dir" [0 1 0]
//
//   | tex1 | 0         | where the geometric normal is along dir, or against it |
//   | tex2 | 1         | where it is perpendicular to dir                       |
//   | dir  | (0, 1, 0) | in the texture's own space; of any length              |
//
// The share of tex1 is the cosine between both.
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class DirectionMixTexture final : public Texture<T> {
 public:
  DirectionMixTexture(TexturePtr<T> along, TexturePtr<T> across, const Vec3& direction)
      : along_(std::move(along)), across_(std::move(across)), direction_(direction) {}

  T evaluate(const TexturePoint& at) const override { return value(at, Evaluate{at}); }
  Carried<T> carried(const TexturePoint& at) const override { return value(at, Carry{at}); }

  std::optional<T> constant() const override {
    const auto along = along_->constant(), across = across_->constant();
    return along && across && *along == *across ? along : std::nullopt;
  }

 private:
  template <class Look>
  auto value(const TexturePoint& at, const Look& look) const {
    const float share = std::abs(dot(at.n, direction_));
    return look(along_) * share + look(across_) * (1 - share);
  }

  TexturePtr<T> along_, across_;
  Vec3 direction_;  // in the world, unit length
};

}  // namespace

template <class T>
TexturePtr<T> make_directionmix(ParamReader& reader, const TextureContext& context) {
  const auto along = value_or_texture<T>(reader, "tex1", 0, "where the surface faces along dir or against it");
  const auto across = value_or_texture<T>(reader, "tex2", 1, "where it faces across dir");
  Vec3 direction = reader.vector("dir", {0, 1, 0}, {}, "in the texture's own space");
  reader.finish();
  Diagnostics& diagnostics = reader.diagnostics();
  direction = normalize(context.world_from_texture.vector(direction));
  if (!is_finite(direction)) {
    reader.error("dir", "\"dir\" has no direction");
    direction = {0, 1, 0};
  }
  return std::make_shared<DirectionMixTexture<T>>(texture_of(along, context.textures, diagnostics),
                                                  texture_of(across, context.textures, diagnostics), direction);
}

template TexturePtr<float> make_directionmix<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_directionmix<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
