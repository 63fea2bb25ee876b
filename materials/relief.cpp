// The parameters that every material has:
//
//   Material "coateddiffuse" "string normalmap" "leather.png"
//   Material "diffuse" "texture displacement" "waves"
//
//   normalmap      file            none   a picture of normals: 2 rgb - 1 is a normal whose z is along the shape's own
//   normaltexture  texture         none   the same as a texture of colours; y is on the side to which v grows, as glTF has it
//   normalscale    float           1      times the slopes of those normals
//   displacement   float texture   none   a height above the surface, in scene units, from which normals are computed
//
// As in pbrt, x of a normal map is along the u tangent, y across it; the picture is read as linear, is repeated outside
// 0..1, and takes precedence if there is a displacement, too. Nothing is moved: outlines stay those of the shape.
// [Blinn 1978, Simulation of Wrinkled Surfaces]
#include "dspm/materials/relief.h"

#include <cmath>
#include <filesystem>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/normal_map.h"
#include "dspm/materials/parameters.h"

namespace dspm {
namespace {

/// The change of the surface along one of the primitive's parameters.
struct Tangent {
  Vec3 p, n;
  Vec2 uv;
};

// The normal of the surface p + d n, whose tangents are dp + dd n + d dn. It is the same whatever parameters they are
// taken along, so the primitive's own will do. dp is that of the smooth surface, perpendicular to the shading normal.
class Bump final : public Relief {
 public:
  explicit Bump(TexturePtr<float> height) : height_(std::move(height)) {}

  Vec3 normal(const SurfacePoint& point, const PlacedShape& shape, int primitive, Vec2 uv) const override {
    constexpr float kStep = 1 / 64.f;
    const auto along = [&](const Vec2& step) {
      const SurfacePoint after = shape.surface_point(primitive, {uv.x + step.x, uv.y + step.y}),
                         before = shape.surface_point(primitive, {uv.x - step.x, uv.y - step.y});
      const auto slope = [](auto a, auto b) { return (a - b) * (0.5f / kStep); };
      return Tangent{slope(after.p, before.p),
                     slope(after.ns, before.ns),
                     {slope(after.uv.x, before.uv.x), slope(after.uv.y, before.uv.y)}};
    };
    const float height = height_->evaluate(texture_point(point));
    const Vec3 n = cross(raised(point, along({kStep, 0}), height), raised(point, along({0, kStep}), height));
    return dot(n, point.ns) < 0 ? -n : n;
  }

 private:
  Vec3 raised(const SurfacePoint& point, const Tangent& tangent, float height) const {
    constexpr float kFar = 0.0005f;  // in texture coordinates, as in pbrt
    const float turn = rounded::hypot(tangent.uv.x, tangent.uv.y), step = turn > 0 ? kFar / turn : kFar;
    SurfacePoint moved = point;
    moved.p = point.p + tangent.p * step;
    moved.uv = {point.uv.x + tangent.uv.x * step, point.uv.y + tangent.uv.y * step};
    const float rise = (height_->evaluate(texture_point(moved)) - height) / step;
    return tangent.p + point.ns * (rise - dot(tangent.p, point.ns)) + tangent.n * height;
  }

  TexturePtr<float> height_;
};

/// Reads a picture of directions, which are no colours.
TexturePtr<Rgb> picture_of_normals(const std::filesystem::path& file, const ParamReader& of, Diagnostics& diagnostics,
                                   const TextureContext& context) {
  const SourceLocation where = of.where("normalmap");
  ParamList list;
  list.params.push_back(
      param_of(ParamType::text, "filename", std::vector{std::filesystem::absolute(file).string()}, where));
  list.params.push_back(param_of(ParamType::text, "encoding", std::vector<std::string>{"linear"}, where));
  ParamReader reader(list, of.subject(), where, diagnostics);
  return make_texture<Rgb>("imagemap", reader, context);
}

}  // namespace

SurfacePoint Relief::bent(const SurfacePoint& point, const PlacedShape& shape, int primitive, Vec2 uv) const {
  constexpr float kLeast = 0.01f;  // the cosine between the normals
  const Vec3 n = normal(point, shape, primitive, uv);
  if (n == point.ns) return point;
  SurfacePoint bent = point;
  bent.ns = normalize(n);
  const float cosine = dot(bent.ns, point.ng);
  if (cosine < kLeast) bent.ns = normalize(bent.ns + point.ng * (kLeast - cosine));
  return is_finite(bent.ns) ? bent : point;
}

std::shared_ptr<const Relief> read_relief(ParamReader& reader, const TextureContext& context) {
  const std::filesystem::path file =
      reader.optional_file("normalmap", "a picture of normals, which replace those of the shape");
  const auto normals = reader.rgb_or_texture("normaltexture", Rgb(0), SpectrumRole::albedo,
                                             "the same as a texture; y is on the side to which v grows");
  const float scale = reader.number("normalscale", 1, "", "times the slopes of those normals");
  const auto height = reader.number_or_texture("displacement", 0, "scene units",
                                               "a height above the surface, from which normals are computed");
  if (!file.empty())
    return std::make_shared<NormalMap>(picture_of_normals(file, reader, reader.diagnostics(), context), scale, false);
  if (!normals.texture.empty())
    return std::make_shared<NormalMap>(texture_of(normals, context.textures, reader.diagnostics()), scale, true);
  if (height.texture.empty()) return nullptr;
  const TexturePtr<float> texture = texture_of(height, context.textures, reader.diagnostics());
  return texture->constant() ? nullptr : std::make_shared<Bump>(texture);
}

}  // namespace dspm
