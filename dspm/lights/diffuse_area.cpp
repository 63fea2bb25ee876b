// AreaLightSource "diffuse" "rgb L" [40 38 34] "bool twosided" true
//
// Makes every point of a shape emit equal radiance in all directions: on the side of its geometric normal, or on
// both. Primitives are chosen by their area in the world, points uniformly within one.
//
// | parameter | default | meaning |
// | --------- | ------- | ------- |
// | L         | 1       | radiance |
// | twosided  | false   | shines on both sides |
// | scale     | 1       | multiplies L |
// | power     | -1      | if above 0: the whole shape is scaled to emit this many lumens, as if L's luminance were 1 |
//
// (pbrt-v4 gives "power" to each triangle of a mesh.)
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.4]
#include "dspm/colour/rgb.h"
#include "dspm/lights/light.h"
#include "dspm/lights/strength.h"
#include "dspm/math/ray.h"
#include "dspm/math/sampling.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

// If a transform stretches a curved primitive, its area is the mean over a grid of samples.
float world_area(const PlacedShape& placed, int primitive) {
  const float area = placed.shape->area(primitive);
  if (!(area > 0)) return 0;
  if (!placed.in_object_space()) return area;
  const int n = placed.shape->triangles() ? 1 : 16;
  double sum = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec2 u{(static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                   (static_cast<float>(y) + 0.5f) / static_cast<float>(n)};
      sum += 1 / static_cast<double>(placed.sample_area(primitive, u).pdf_a);
    }
  return static_cast<float>(sum / (n * n));
}

Distribution1D primitives_by_area(const PlacedShape& placed) {
  std::vector<float> areas(static_cast<std::size_t>(placed.shape->primitive_count()));
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = world_area(placed, static_cast<int>(i));
  return Distribution1D(areas);
}

// Area light over all primitives; every density of a point is by area in the world.
class DiffuseArea final : public Light {
 public:
  DiffuseArea(const PlacedShape& placed, const Rgb& radiance, bool two_sided, const Strength& strength)
      : placed_(placed), primitives_(primitives_by_area(placed)), two_sided_(two_sided) {
    const float flux_at_1 = kPi * primitives_.total() * sides();
    radiance_ = radiance * strength.factor(flux_at_1);
    power_ = radiance_ * flux_at_1;
  }

  Rgb power() const override { return power_; }

  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override {
    if (!(primitives_.total() > 0)) return std::nullopt;
    const Start s = sample_point(u_position);
    float side = 1;
    if (two_sided_) {
      side = u_direction.x < 0.5f ? 1.f : -1.f;
      u_direction.x = 2 * u_direction.x - (side < 0 ? 1.f : 0.f);
    }
    const Vec3 local = cosine_hemisphere(u_direction);
    const Vec3 w = normalize(Basis::around(side * s.point.ng).to_world(local));
    return Emission{s.point.spawn(w), radiance_ * (kPi * sides() / s.pdf_a), pdf(s.pdf_a, dot(s.point.ng, w)),
                    s.point.ng, s.primitive};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3& normal, int primitive) const override {
    return pdf(pdf_a(primitive, normal), dot(normal, start.direction));
  }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3& normal, int primitive) const override {
    const float side = two_sided_ && dot(normal, start.direction) < 0 ? -1.f : 1.f;
    const Vec3 local = Basis::around(side * normal).to_local(start.direction);
    Vec2 direction = concentric_disk_numbers({local.x, local.y});
    if (two_sided_) direction.x = 0.5f * (direction.x + (side < 0 ? 1.f : 0.f));
    const auto place = placed_.area_numbers(primitive, start.origin);
    if (!place) return {kAnyNumber, kAnyNumber, direction.x, direction.y};
    return {primitives_.number(primitive, std::clamp(place->x, 0.f, 1.f)), place->y, direction.x, direction.y};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2 u) const override {
    if (!(primitives_.total() > 0)) return std::nullopt;
    const Start s = sample_point(u);
    const Vec3 d = s.point.p - p;
    const float distance = length(d);
    const Vec3 wi = d / distance;
    const Rgb radiance = emitted(s.point, -wi);
    if (!(distance > 0) || is_black(radiance)) return std::nullopt;
    return Illumination{wi,         distance,   radiance, s.pdf_a * length2(d) / std::abs(dot(s.point.ng, wi)),
                        s.point.ng, s.primitive};
  }

  Rgb emitted(const SurfacePoint& point, const Vec3& w) const override {
    const float cosine = dot(point.ng, w);
    return cosine > 0 || (two_sided_ && cosine < 0) ? radiance_ : Rgb();
  }

  float pdf_w(const Vec3& from, const SurfacePoint& point, int primitive) const override {
    const Vec3 d = point.p - from;
    if (is_black(emitted(point, -d))) return 0;
    return pdf_a(primitive, point.ng) * length2(d) * length(d) / std::abs(dot(point.ng, d));
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const DiffuseArea*>(&other);
    if (o == nullptr || !(&placed_ == &o->placed_ && two_sided_ == o->two_sided_)) return std::nullopt;
    return ratio(radiance_, o->radiance_);
  }

 private:
  struct Start : AreaSample {
    int primitive;
  };

  float sides() const { return two_sided_ ? 2.f : 1.f; }

  Start sample_point(Vec2 u) const {
    const auto [primitive, probability, rest] = primitives_.choose(u.x);
    Start s{placed_.sample_area(primitive, {rest, u.y}), primitive};
    s.pdf_a *= probability;
    return s;
  }

  /// `cosine` of the direction to the normal.
  EmissionPdf pdf(float pdf_a, float cosine) const {
    return {pdf_a, cosine_hemisphere_pdf_w(two_sided_ ? std::abs(cosine) : cosine) / sides(), false, false};
  }

  float pdf_a(int primitive, const Vec3& ng) const {
    return primitives_.probability(primitive) * placed_.pdf_a(primitive, ng);
  }

  const PlacedShape& placed_;
  Distribution1D primitives_;
  bool two_sided_;
  Rgb radiance_, power_;
};

}  // namespace

std::unique_ptr<Light> make_diffuse_area(ParamReader& reader, const LightContext& context) {
  const Rgb radiance = reader.rgb("L", Rgb(1), SpectrumRole::illuminant, "radiance in all directions");
  const bool two_sided = reader.flag("twosided", false, "shines on both sides");
  const Strength strength = read_power(reader);
  reader.unsupported("filename", "an area light's image");
  reader.finish();
  return std::make_unique<DiffuseArea>(*context.shape, radiance, two_sided, strength);
}

}  // namespace dspm
