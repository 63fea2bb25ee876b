// Light of the same radiance from all directions of a cone. It is an infinite light: rays that leave the scene see it,
// so do mirrors, and what it sends through glass is found from both ends.
#include "dspm/lights/sun_disk.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/lights/scene_sphere.h"

namespace dspm {
namespace {

// Angles are given by their versine, 1 - cos, which has digits left where the cosine has none, and in which solid
// angles are even.
class SunDisk final : public Light {
 public:
  SunDisk(const SceneSphere& scene, const Vec3& towards_light, const Rgb& radiance, float rim)
      : scene_(scene), axis_(Basis::around(towards_light)), radiance_(radiance), rim_(rim) {}

  Rgb power() const override { return radiance_ * (scene_.disk_area() / density()); }

  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override {
    return Emission{scene_.entering(draw(u_direction), u_position), power(), pdf(true)};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const override { return pdf(shines_from(-start.direction)); }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const Vec2 position = scene_.entering_numbers(start);
    const Vec3 towards = -start.direction;
    return {position.x, position.y, std::min(versine(towards) / rim_, 1.f), turn_of(axis_.to_local(towards))};
  }

  std::optional<Illumination> illuminate(const Vec3&, Vec2 u) const override {
    return Illumination{draw(u), kInfinity, radiance_, density()};
  }

  bool is_infinite() const override { return true; }
  Rgb escaped(const Ray& ray) const override { return shines_from(ray.direction) ? radiance_ : Rgb(); }
  float escaped_pdf_w(const Ray& ray) const override { return shines_from(ray.direction) ? density() : 0; }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const SunDisk*>(&other);
    if (o == nullptr || !(axis_.z == o->axis_.z && rim_ == o->rim_)) return std::nullopt;
    return ratio(radiance_, o->radiance_);
  }

  // A disk within the other.
  bool starts_like(const Light& other) const override {
    const auto* o = dynamic_cast<const SunDisk*>(&other);
    return o != nullptr && axis_.z == o->axis_.z && rim_ <= o->rim_ && o->rim_ <= kMostWeight * rim_ &&
           ratio(radiance_, o->radiance_);
  }
  Rgb ratio_along(const Light& other, const Ray& start) const override {
    return shines_from(-start.direction) ? *ratio(radiance_, static_cast<const SunDisk&>(other).radiance_) : Rgb();
  }

 private:
  Vec3 draw(Vec2 u) const { return normalize(axis_.to_world(uniform_cone(u, rim_))); }
  float versine(const Vec3& towards) const { return 0.5f * length2(towards - axis_.z); }
  bool shines_from(const Vec3& towards) const { return versine(towards) <= rim_; }
  float density() const { return uniform_cone_pdf_w(rim_); }
  EmissionPdf pdf(bool shines) const { return {1 / scene_.disk_area(), shines ? density() : 0, false, false}; }

  SceneSphere scene_;
  Basis axis_;
  Rgb radiance_;
  float rim_;  // the versine there
};

}  // namespace

// A surface that faces the disk counts directions by their cosine: their integral is pi sin^2 of the rim's angle.
std::unique_ptr<Light> make_sun_disk(const LightContext& context, const Vec3& towards_light, const Rgb& irradiance,
                                     float angle) {
  const double s = std::sin(static_cast<double>(angle) / 720 * M_PI), rim = 2 * s * s;
  const auto faced = static_cast<float>(M_PI * rim * (2 - rim));
  const SceneSphere scene{context.scene_center, context.scene_radius};
  return std::make_unique<SunDisk>(scene, towards_light, irradiance / faced, static_cast<float>(rim));
}

}  // namespace dspm
