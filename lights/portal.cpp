#include "dspm/lights/portal.h"

#include <algorithm>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light_space.h"
#include "dspm/lights/scene_sphere.h"
#include "dspm/lights/window_map.h"

namespace dspm {
namespace {

/// The light that shines through, by directions in the window's space.
struct Sky {
  EnvironmentMap map;
  LightSpace space;
  Basis window;

  Rgb radiance(const Vec3& w) const { return map.radiance(space.to_light(window.to_world(w))); }
  friend bool operator==(const Sky& a, const Sky& b) { return a.space == b.space && a.map == b.map; }
};

/// Makes a map as fine as the picture, within bounds.
WindowMap map_of(const Sky& sky) {
  const int size = sky.map.size(), side = std::clamp(size, 128, 1024);
  return WindowMap(side, std::clamp((2 * size - 1) / side + 1, 2, 4), [&](const Vec3& w) { return sky.radiance(w); });
}

/// A point sees the light along the rays that pass the portal; what lies beyond it casts shadows. Photons start outside
/// the scene, on lines through the portal, and are lost if something lies before it.
class PortalLight final : public Light {
 public:
  PortalLight(const LightContext& context, const EnvironmentMap& map, float scale, const Rectangle& portal,
              std::optional<Background> background)
      : scene_{context.scene_center, context.scene_radius},
        portal_(portal),
        sky_{map, LightSpace(context.to_world), portal.basis},
        map_(map_of(sky_)),
        scale_(scale),
        background_(std::move(background)),
        power_(map_.irradiance() * (portal.area() * scale)) {}

  Rgb power() const override { return power_; }

  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override {
    if (map_.is_black()) return std::nullopt;
    const WindowMap::Sample s = map_.sample_crossing(u_direction);
    const Vec3 w = portal_.basis.to_world(s.direction), through = portal_.at(u_position);
    const EmissionPdf pdf = this->pdf(s.direction.z, s.pdf_w);
    if (!(pdf.position * pdf.direction > 0)) return std::nullopt;
    const float outside = std::max(0.f, dot(scene_.center - through, w) + SceneSphere::kClear * scene_.radius);
    Emission e{{through + w * outside, -w}, scale_ * sky_.radiance(s.direction) / (pdf.position * pdf.direction), pdf};
    e.must_reach = outside * (1 - 1e-5f);
    return e;
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const override {
    const Vec3 w = portal_.basis.to_local(-start.direction);
    if (!(w.z > 0) || !portal_.place_of(start)) return {};
    return pdf(w.z, map_.crossing_pdf_w(WindowMap::place_of(w)));
  }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const auto place = portal_.place_of(start);
    if (!place) return {kAnyNumber, kAnyNumber, kAnyNumber, kAnyNumber};
    const Vec2 u = map_.crossing_numbers(WindowMap::place_of(portal_.basis.to_local(-start.direction)));
    return {place->x, place->y, u.x, u.y};
  }

  std::optional<Illumination> illuminate(const Vec3& p, Vec2 u) const override {
    const auto part = seen_from(p);
    const auto s = part ? map_.sample(*part, u) : std::nullopt;
    if (!s) return std::nullopt;
    return Illumination{portal_.basis.to_world(s->direction), kInfinity, scale_ * sky_.radiance(s->direction),
                        s->pdf_w};
  }

  bool is_infinite() const override { return true; }
  Rgb escaped(const Ray& ray) const override {
    return seen_along(ray) ? scale_ * sky_.radiance(portal_.basis.to_local(ray.direction)) : Rgb();
  }
  Rgb background(const Ray& ray) const override {
    if (!background_ || !seen_along(ray)) return escaped(ray);
    return background_->scale * background_->map.radiance(sky_.space.to_light(ray.direction));
  }
  float escaped_pdf_w(const Ray& ray) const override {
    const auto place = seen_along(ray);
    return place ? map_.pdf_w(*seen_from(ray.origin), *place) : 0;
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const PortalLight*>(&other);
    if (o == nullptr || !(portal_ == o->portal_ && sky_ == o->sky_)) return std::nullopt;
    return ratio(Rgb(scale_), Rgb(o->scale_));
  }

 private:
  /// Across the direction, the portal is smaller by the cosine.
  EmissionPdf pdf(float cosine, float pdf_w) const { return {1 / (portal_.area() * cosine), pdf_w, false, false}; }

  /// Returns the directions in which p sees the portal; nullopt from its other side.
  std::optional<WindowMap::Part> seen_from(const Vec3& p) const {
    const Vec3 low = portal_.basis.to_local(portal_.corner - p);
    if (!(low.z > 0)) return std::nullopt;
    return WindowMap::Part{WindowMap::place_of(low), WindowMap::place_of(low + Vec3{portal_.width, portal_.height, 0})};
  }
  /// Returns the place of the ray's direction, if the ray passes the portal.
  std::optional<Vec2> seen_along(const Ray& ray) const {
    const Vec3 w = portal_.basis.to_local(ray.direction);
    const auto part = w.z > 0 ? seen_from(ray.origin) : std::nullopt;
    if (!part) return std::nullopt;
    const Vec2 place = WindowMap::place_of(w);
    return part->contains(place) ? std::optional(place) : std::nullopt;
  }

  SceneSphere scene_;
  Rectangle portal_;
  Sky sky_;
  WindowMap map_;
  float scale_;
  std::optional<Background> background_;
  Rgb power_;
};

}  // namespace

std::optional<Rectangle> read_portal(ParamReader& reader) {
  const std::vector<Vec3> points =
      reader.points3("portal", "four points of a rectangle in the world that the light must pass");
  if (points.empty()) return std::nullopt;
  const std::optional<Rectangle> portal = rectangle_of(points);
  if (!portal)
    reader.error("portal", "the portal of " + reader.subject() + " must have four points that make a rectangle",
                 "from the first point, the last is along x, the second along y, and the light comes from x cross y");
  return portal;
}

std::unique_ptr<Light> make_portal_light(const LightContext& context, const EnvironmentMap& map, float scale,
                                         const Rectangle& portal, std::optional<Background> background) {
  return std::make_unique<PortalLight>(context, map, scale, portal, std::move(background));
}

}  // namespace dspm
