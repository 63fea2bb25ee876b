#include "dspm/materials/normal_map.h"

#include "dspm/base/colour/rgb.h"
#include "dspm/materials/parameters.h"

namespace dspm {

NormalMap::NormalMap(TexturePtr<Rgb> picture, float scale, bool by_v)
    : picture_(std::move(picture)), scale_(scale), by_v_(by_v) {}

Vec3 NormalMap::leaning(const SurfacePoint& point) const {
  const Rgb c = picture_->evaluate(texture_point(point));
  const Vec3 n{scale_ * (2 * c.r - 1), scale_ * (2 * c.g - 1), 2 * c.b - 1};
  if (n.x == 0 && n.y == 0 && n.z > 0) return point.ns;
  Basis basis = Basis::around(point.ns, point.dpdu);
  if (by_v_ && dot(basis.y, point.dpdv) < 0) basis.y = -basis.y;  // mirrored coordinates, or a mirrored world
  return basis.to_world(n);
}

std::shared_ptr<const NormalMap> read_coat_relief(ParamReader& reader, const MaterialContext& context) {
  const auto normals = reader.rgb_or_texture("coatnormaltexture", Rgb(0), SpectrumRole::albedo,
                                             "normals of the coat, as normaltexture's of the rest");
  const float scale = reader.number("coatnormalscale", 1, "", "times the slopes of those normals");
  if (normals.texture.empty()) return nullptr;
  return std::make_shared<NormalMap>(texture_of(normals, context.textures, reader.diagnostics()), scale, true);
}

}  // namespace dspm
