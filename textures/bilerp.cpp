// Four values at the corners of the unit square, bilinear between them; the same slopes go on outside.
//
//   Texture "dawn" "spectrum" "bilerp" "rgb v00" [.1 .1 .3] "rgb v10" [.1 .1 .3] "rgb v01" [1 .6 .3] "rgb v11" [1 .8 .5]
//
//   | v00 | 0 | at (0, 0) |
//   | v01 | 1 | at (0, 1) |
//   | v10 | 0 | at (1, 0) |
//   | v11 | 1 | at (1, 1) |
//   and the mapping's parameters, see mapping.h
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class BilerpTexture final : public Texture<T> {
 public:
  BilerpTexture(const SquareCorners<T>& corners, const TextureMapping& mapping)
      : corners_(corners), mapping_(mapping) {}

  T evaluate(const TexturePoint& at) const override { return corners_.at(mapping_.at(at)); }

  std::optional<T> constant() const override {
    const auto& [v00, v01, v10, v11] = corners_;
    return v00 == v01 && v00 == v10 && v00 == v11 ? std::optional<T>(v00) : std::nullopt;
  }
  std::optional<PlainTexture<T>> plain() const override {
    const auto mapping = mapping_.plain();
    return mapping ? std::optional<PlainTexture<T>>(PlainBilerp<T>{corners_, *mapping}) : std::nullopt;
  }

 private:
  SquareCorners<T> corners_;
  TextureMapping mapping_;
};

template <class T>
T read_value(ParamReader& reader, std::string_view name, float fallback, std::string_view sentence) {
  if constexpr (std::is_same_v<T, float>)
    return reader.number(name, fallback, {}, sentence);
  else
    return reader.rgb(name, Rgb(fallback), SpectrumRole::albedo, sentence);
}

}  // namespace

template <class T>
TexturePtr<T> make_bilerp(ParamReader& reader, const TextureContext& context) {
  SquareCorners<T> corners;
  corners.v00 = read_value<T>(reader, "v00", 0, "at (0, 0)");
  corners.v01 = read_value<T>(reader, "v01", 1, "at (0, 1)");
  corners.v10 = read_value<T>(reader, "v10", 0, "at (1, 0)");
  corners.v11 = read_value<T>(reader, "v11", 1, "at (1, 1)");
  const TextureMapping mapping = TextureMapping::read(reader, context.world_from_texture);
  reader.finish();
  return std::make_shared<BilerpTexture<T>>(corners, mapping);
}

template TexturePtr<float> make_bilerp<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_bilerp<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
