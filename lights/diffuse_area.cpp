// AreaLightSource "diffuse" "rgb L" [40 38 34] "bool twosided" true
//
// Makes every point of a shape emit equal radiance in all directions: on the side of its geometric normal, or on both.
// Points are drawn uniformly by their area in the world, or, if the radiance varies over the surface, in proportion to
// it.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | L         | 1       | radiance |
// | filename  | ""      | instead of L: a picture of the radiance; (0, 0) of the shape's texture coordinates is its lower left corner |
// | twosided  | false   | shines on both sides |
// | scale     | 1       | multiplies L or the picture |
// | power     | -1      | if above 0: the whole shape is scaled to emit this many lumens, as if L's luminance were 1 |
//
// A picture keeps its luminances as ratios under "power". (pbrt-v4 gives "power" to each triangle of a mesh.)
//
// A shape whose material emits ("principled") gets a light of this kind, with the material's texture as a factor.
//
// Where the shape lets a part of the rays through ("alpha"), it emits as much less. A shape that is a hole everywhere,
// in all frames, emits all of its light, and no ray can hit it.
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.4]
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/lights/diffuse_emission.h"
#include "dspm/lights/emission_pattern.h"
#include "dspm/lights/emission_picture.h"
#include "dspm/lights/emitter_points.h"
#include "dspm/lights/light.h"
#include "dspm/lights/read_environment.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

/// The properties of a diffuse area light.
struct Glow {
  Rgb radiance;
  std::optional<EmissionPicture> picture;                    // multiplies the radiance
  std::shared_ptr<const EmissionPattern> pattern = nullptr;  // likewise

  bool varies() const { return picture || pattern; }
  DiffuseEmission directions = {};  // of light from each point
  bool hidden = false;              // no ray can hit it
};

// Every density of a point is by area in the world. A light that no ray can hit is one in which each path picks a point
// that has a density of 1: a random lamp without a surface.
class DiffuseArea final : public Light {
 public:
  DiffuseArea(const PlacedShape& placed, Glow glow, const Strength& strength)
      : placed_(placed),
        glow_(std::move(glow)),
        points_(placed, brightness(), glow_.pattern ? Measured::deferred : Measured::at_once,
                glow_.directions.two_sided),
        bounds_(bounds_of_emitter(placed, glow_.directions.two_sided)) {
    const Rgb flux_at_1 = points_.total() * (kPi * glow_.directions.sides());
    glow_.radiance = glow_.radiance * strength.factor(luminance(flux_at_1));
    power_ = glow_.radiance * flux_at_1;
  }

  Rgb power() const override { return power_; }
  std::optional<LightBounds> bounds() const override { return bounds_; }

  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override {
    if (points_.empty()) return std::nullopt;
    const EmitterPoints::Start s = points_.sample(u_position);
    const Vec3 w = glow_.directions.sample(s.point.ng, u_direction);
    return Emission{s.point.spawn(w),
                    radiance_at(s.point) * present_at(s.point) * (kPi * glow_.directions.sides() / s.pdf_a),
                    pdf(s.pdf_a, dot(s.point.ng, w)), s.point.ng, s.primitive};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3& normal, int primitive) const override {
    return pdf(points_.pdf_a(primitive, start.origin, normal), dot(normal, start.direction));
  }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3& normal, int primitive) const override {
    const Vec2 direction = glow_.directions.numbers(normal, start.direction);
    const auto place = points_.numbers(primitive, start.origin);
    if (!place) return {kAnyNumber, kAnyNumber, direction.x, direction.y};
    return {place->x, place->y, direction.x, direction.y};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2 u) const override {
    if (points_.empty()) return std::nullopt;
    const EmitterPoints::Seen s = points_.sample_seen(p, u);
    const Vec3 d = s.point.p - p;
    const float distance = length(d);
    const Vec3 wi = d / distance;
    const Rgb radiance = emitted(s.point, -wi) * present_at(s.point);
    // Edge-on, rounding may leave a cosine here and none in the density.
    if (!(distance > 0) || is_black(radiance) || !std::isfinite(s.pdf_w)) return std::nullopt;
    return glow_.hidden ? Illumination{wi, distance, radiance / s.pdf_w, 0, s.point.ng, s.primitive}
                        : Illumination{wi, distance, radiance, s.pdf_w, s.point.ng, s.primitive};
  }

  Rgb emitted(const SurfacePoint& point, const Vec3& w) const override {
    return glow_.directions.shines(dot(point.ng, w)) ? radiance_at(point) : Rgb();
  }

  float pdf_w(const Vec3& from, const SurfacePoint& point, int primitive) const override {
    if (glow_.hidden || !shines_along(point, from - point.p)) return 0;
    return points_.seen_pdf_w(from, primitive, point.p, point.ng);
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const DiffuseArea*>(&other);
    if (o == nullptr || &placed_ != &o->placed_ || glow_.directions.two_sided != o->glow_.directions.two_sided ||
        glow_.pattern != o->glow_.pattern || !(glow_.picture == o->glow_.picture))
      return std::nullopt;
    return ratio(glow_.radiance, o->glow_.radiance);
  }

 private:
  using Measured = EmitterPoints::Measured;

  bool shines_along(const SurfacePoint& point, const Vec3& w) const {
    return glow_.directions.shines(dot(point.ng, w)) && !is_black(glow_.radiance);
  }
  Rgb radiance_at(const SurfacePoint& point) const {
    return glow_.varies() ? glow_.radiance * relative_at(point) : glow_.radiance;
  }
  Rgb relative_at(const SurfacePoint& point) const {
    const Rgb picture = glow_.picture ? glow_.picture->at(point.uv) : Rgb(1);
    return glow_.pattern ? picture * glow_.pattern->at(point) : picture;
  }
  /// The fraction of the surface that is there. Rays that hit it have passed that test.
  float present_at(const SurfacePoint& point) const {
    if (glow_.hidden || placed_.cutout == nullptr) return 1;
    return std::clamp(placed_.cutout->alpha(point), 0.f, 1.f);
  }
  EmitterPoints::Brightness brightness() const {
    if (!glow_.varies() && (glow_.hidden || placed_.cutout == nullptr)) return nullptr;
    return [this](const SurfacePoint& point) { return relative_at(point) * present_at(point); };
  }

  /// Returns the densities for the `cosine` of the direction to the normal.
  EmissionPdf pdf(float pdf_a, float cosine) const {
    return {glow_.hidden ? 1 : pdf_a, glow_.directions.pdf_w(cosine), glow_.hidden, false};
  }

  const PlacedShape& placed_;
  Glow glow_;
  EmitterPoints points_;
  LightBounds bounds_;
  Rgb power_;
};

std::optional<EmissionPicture> read_emission(ParamReader& reader, const std::filesystem::path& path) {
  try {
    return EmissionPicture(read_light_image(path, reader));
  } catch (const std::runtime_error& unreadable) {
    reader.error("filename", unreadable.what());
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<Light> make_diffuse_area(ParamReader& reader, const LightContext& context) {
  return make_diffuse_area(reader, context, nullptr);
}

std::unique_ptr<Light> make_diffuse_area(ParamReader& reader, const LightContext& context,
                                         std::shared_ptr<const EmissionPattern> pattern) {
  Glow glow;
  glow.radiance = reader.rgb("L", Rgb(1), SpectrumRole::illuminant, "radiance in all directions");
  const std::filesystem::path path =
      reader.optional_file("filename", "instead of L: a picture of the radiance, placed by texture coordinates");
  glow.directions.two_sided = reader.flag("twosided", false, "shines on both sides");
  glow.hidden = context.hidden;
  glow.pattern = std::move(pattern);
  const Strength strength = read_power(reader);
  if (reader.has("L") && reader.has("filename"))
    reader.error("filename", "the radiance is either \"L\" or a picture, not both", "\"scale\" multiplies a picture");
  reader.finish();
  if (!path.empty()) glow.picture = read_emission(reader, path);
  return std::make_unique<DiffuseArea>(*context.shape, std::move(glow), strength);
}

}  // namespace dspm
