// LightSource "infinite" "string filename" "sky.exr" "float scale" 2
//
// Light from all directions: of one colour, or an image around the scene, bilinear between the centres of its pixels
// also across the image's rim. Directions are sampled in exact proportion to its luminance. Photons start on a disk,
// perpendicular to their direction, that covers the sphere around the scene.
//
// | parameter   | default | meaning |
// | ----------- | ------- | ------- |
// | L           | 1       | radiance of one colour; instead of filename |
// | filename    |         | picture of the radiance, of any format of image.h |
// | mapping     | auto    | equalarea: pbrt-v4's squares; equirectangular: latitude, longitude; auto: by the aspect |
// | scale       | 1       | multiplies L or the image |
// | portal      |         | four points in the world: the light comes only through their rectangle, from x cross y, where
// |             |         | x leads from the first point to the last and y from the first to the second |
// | background  |         | radiance that the camera sees behind everything, instead of the light |
// | backgroundblur | 0   | degrees by which it sees the image blurred there; mirrors and glass show it as it is |
// | illuminance | -1      | if above 0: lux on a surface facing +z of light space; with L, as if its luminance were 1 |
//
// +z of light space is the middle of a square image and the top row of a latitude-longitude one. With an image,
// "illuminance" gives half of what pbrt-v4 gives, which counts each pixel at half its solid angle. A pole of a
// latitude-longitude image has the mean of the pixels around it.
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.5; Clarberg 2008, Fast Equal-Area Mapping of the
// (Hemi)Sphere using SIMD]
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/lights/background.h"
#include "dspm/lights/environment_map.h"
#include "dspm/lights/light.h"
#include "dspm/lights/light_space.h"
#include "dspm/lights/portal.h"
#include "dspm/lights/read_environment.h"
#include "dspm/lights/scene_sphere.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

class Infinite final : public Light {
 public:
  Infinite(const LightContext& context, EnvironmentMap map, float scale, std::optional<Background> background)
      : scene_{context.scene_center, context.scene_radius},
        space_(context.to_world),
        map_(std::move(map)),
        scale_(scale),
        background_(std::move(background)),
        power_(map_.fluence() * (scene_.disk_area() * scale)) {}

  Rgb power() const override { return power_; }

  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override {
    if (map_.is_black()) return std::nullopt;
    const EnvironmentMap::Sample s = draw(u_direction);
    if (!(s.pdf_w > 0)) return std::nullopt;
    return Emission{scene_.entering(s.direction, u_position), s.radiance * (scene_.disk_area() / s.pdf_w),
                    pdf(s.pdf_w)};
  }

  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const override {
    return pdf(escaped_pdf_w({start.origin, -start.direction}));
  }

  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const override {
    const Vec2 position = scene_.entering_numbers(start),
               direction = map_.sample_numbers(space_.to_light(-start.direction));
    return {position.x, position.y, direction.x, direction.y};
  }

  std::optional<Illumination> illuminate(const Vec3&, Vec2 u) const override {
    if (map_.is_black()) return std::nullopt;
    const EnvironmentMap::Sample s = draw(u);
    if (!(s.pdf_w > 0)) return std::nullopt;
    return Illumination{s.direction, kInfinity, s.radiance, s.pdf_w};
  }

  void prefetch(Vec2 u) const override { map_.prefetch(u); }

  bool is_infinite() const override { return true; }
  Rgb escaped(const Ray& ray) const override { return scale_ * map_.radiance(space_.to_light(ray.direction)); }

  Rgb background(const Ray& ray) const override {
    return background_ ? background_->scale * background_->map.radiance(space_.to_light(ray.direction)) : escaped(ray);
  }

  float escaped_pdf_w(const Ray& ray) const override {
    const Vec3 w = space_.to_light(ray.direction);
    return map_.pdf_w(w) * space_.density_scale(w);
  }

  std::optional<Rgb> ratio_to(const Light& other) const override {
    const auto* o = dynamic_cast<const Infinite*>(&other);
    if (o == nullptr || !(space_ == o->space_)) return std::nullopt;
    if (map_.constant() && o->map_.constant()) return ratio(scale_ * *map_.constant(), o->scale_ * *o->map_.constant());
    if (!(map_ == o->map_)) return std::nullopt;
    return ratio(Rgb(scale_), Rgb(o->scale_));
  }

 private:
  EmissionPdf pdf(float pdf_w) const { return {1 / scene_.disk_area(), pdf_w, false, false}; }

  EnvironmentMap::Sample draw(Vec2 u) const {
    const EnvironmentMap::Sample s = map_.sample(u);
    return {space_.to_world(s.direction), scale_ * s.radiance, s.pdf_w * space_.density_scale(s.direction)};
  }

  SceneSphere scene_;
  LightSpace space_;
  EnvironmentMap map_;
  float scale_;
  std::optional<Background> background_;
  Rgb power_;  // an estimate if the transform stretches
};

EnvironmentMap constant(const Rgb& radiance) {
  Image image(1, 1);
  image.at(0, 0) = radiance;
  return EnvironmentMap(image, SphereMapping::equal_area);
}

}  // namespace

std::unique_ptr<Light> make_infinite(ParamReader& reader, const LightContext& context) {
  const Rgb radiance = reader.rgb("L", Rgb(1), SpectrumRole::illuminant, "radiance of one colour from everywhere");
  const std::filesystem::path file = reader.optional_file("filename", "an image of the radiance, instead of L");
  const std::string mapping =
      reader.choice("mapping", "auto", kMappingWords, "how the image covers the sphere; auto: by its aspect ratio");
  const Strength strength = read_illuminance(reader);
  const std::optional<Rectangle> portal = read_portal(reader);
  const BackgroundChoice choice = read_background(reader);
  if (reader.has("L") && reader.has("filename"))
    reader.error("filename", reader.subject() + " takes \"L\" or \"filename\", not both");
  if (choice.blur > 0 && file.empty())
    reader.error("backgroundblur", "there is no image to be blurred", "\"filename\" names it");
  reader.finish();

  EnvironmentMap map = constant(radiance);
  float scale = strength.factor(kPi);
  std::optional<Background> background;
  if (!file.empty()) try {
      const Image image = read_light_image(file, reader);
      const SphereMapping kind = mapping_of(image, mapping);
      map = EnvironmentMap(image, kind);
      scale = strength.factor(map.illuminance());
      if (choice.blur > 0) background = Background{blurred(image, kind, choice.blur), scale};
    } catch (const std::runtime_error& e) {
      reader.error("filename", e.what());
    }
  if (choice.colour) background = Background{constant(*choice.colour)};
  if (portal) return make_portal_light(context, map, scale, *portal, std::move(background));
  return std::make_unique<Infinite>(context, std::move(map), scale, std::move(background));
}

}  // namespace dspm
