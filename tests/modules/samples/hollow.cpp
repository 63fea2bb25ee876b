// A material, a light, a camera and a shape that are right in most places, and give NaN in some.
#include <dspm/base/math/sampling.h>
#include <dspm/materials/shading_frame.h>
#include <dspm/session/modules/module.h>

#include <cmath>
#include <limits>

namespace {

using namespace dspm;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kIntensity = 12;

enum class Fault { f, weight, direction, constant };

class HollowBsdf final : public Bsdf {
 public:
  HollowBsdf(const SurfacePoint& point, Fault fault) : frame_(point), fault_(fault), here_(point.p.x > 0) {}

  LobeSet lobes(float) const override { return 1; }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet) const override {
    return LocalPair(frame_, wo, wi, transport).reflection() ? Spectrum(is(Fault::f) ? kNan : 0.2f) : Spectrum(0);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet) const override {
    const LocalPair pair(frame_, wo, wi, transport);
    return pair.reflection() ? pair.share * cosine_hemisphere_pdf_w(pair.wi.z) : 0;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet) const override {
    const Vec3 local = cosine_hemisphere({u.x, u.y});
    const float side = frame_.side(wo);
    if (!frame_.arrive(wo, side, transport)) return std::nullopt;
    const auto leaving = frame_.leave(local, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const Spectrum weight(is(Fault::weight) ? kNan : 0.2f * kPi / leaving->share);
    const Vec3 wi = is(Fault::direction) ? leaving->wi * kNan : leaving->wi;
    return BsdfSample{wi, weight, leaving->share * cosine_hemisphere_pdf_w(local.z), false};
  }
  float lobe_probability(const Vec3&, LobeSet) const override { return 1; }
  std::optional<Spectrum> lambertian(LobeSet) const override {
    return fault_ == Fault::constant ? std::optional(Spectrum(here_ ? kNan : 0.2f)) : std::nullopt;
  }

 private:
  bool is(Fault fault) const { return here_ && fault_ == fault; }

  ShadingFrame frame_;
  Fault fault_;
  bool here_;
};

class HollowMaterial final : public Material {
 public:
  explicit HollowMaterial(Fault fault) : fault_(fault) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<HollowBsdf>(point, fault_);
  }

 private:
  Fault fault_;
};

std::unique_ptr<Material> make_material(ParamReader& reader, const MaterialContext&) {
  const std::string fault = reader.choice("fault", "f", {"f", "weight", "direction", "constant"}, "what is not finite");
  reader.finish();
  return std::make_unique<HollowMaterial>(fault == "weight"      ? Fault::weight
                                          : fault == "direction" ? Fault::direction
                                          : fault == "constant"  ? Fault::constant
                                                                 : Fault::f);
}

/// A point light that gives NaN to one side.
class HollowLight final : public Light {
 public:
  explicit HollowLight(const Vec3& place) : place_(place) {}
  Rgb power() const override { return Rgb(kIntensity * 4 * kPi); }
  std::optional<Emission> emit(Vec2, Vec2 u) const override {
    const Vec3 direction = uniform_sphere(u);
    return Emission{{place_, direction}, Rgb(direction.x > 0 ? kNan : kIntensity * 4 * kPi)};
  }
  std::optional<Illumination> illuminate(const Vec3& p, Vec2) const override {
    const Vec3 to_light = place_ - p;
    const float distance = length(to_light);
    const float irradiance = p.x > place_.x ? kNan : kIntensity / (distance * distance);
    return Illumination{to_light / distance, distance, Rgb(irradiance), 0};
  }

 private:
  Vec3 place_;
};

std::unique_ptr<Light> make_light(ParamReader& reader, const LightContext& context) {
  reader.finish();
  return std::make_unique<HollowLight>(context.to_world.point({0, 0, 0}));
}

/// Parallel rays, and none in the right half of the image.
class HollowCamera final : public Camera {
 public:
  explicit HollowCamera(const CameraContext& context) : context_(context) {}
  Ray ray(Vec2 film, Vec2) const override {
    const auto width = static_cast<float>(context_.width), height = static_cast<float>(context_.height);
    const Vec3 origin{(film.x - width / 2) / height, (height / 2 - film.y) / height, 0};
    const Vec3 from = context_.to_world.point(film.x > width / 2 ? origin * kNan : origin);
    return {from, normalize(context_.to_world.vector({0, 0, 1}))};
  }
  float pixel_spacing(float) const override { return 1 / static_cast<float>(context_.height); }

 private:
  CameraContext context_;
};

std::unique_ptr<Camera> make_camera(ParamReader& reader, const CameraContext& context) {
  reader.finish();
  return std::make_unique<HollowCamera>(context);
}

/// A square in the plane z = 0 whose right half has no normal.
class HollowShape final : public Shape {
 public:
  Bounds3 bounds(int) const override { return {{-1, -1, 0}, {1, 1, 0}}; }
  std::optional<PrimitiveHit> intersect(int, const Ray& ray) const override {
    const float t = -ray.origin.z / ray.direction.z;
    if (!(t > 0 && t < ray.t_max)) return std::nullopt;
    const Vec3 p = ray.at(t);
    if (!(std::abs(p.x) <= 1 && std::abs(p.y) <= 1)) return std::nullopt;
    return PrimitiveHit{t, {(p.x + 1) / 2, (p.y + 1) / 2}};
  }
  SurfacePoint surface_point(int, Vec2 uv) const override {
    SurfacePoint point;
    point.p = {2 * uv.x - 1, 2 * uv.y - 1, 0};
    point.p_error = {1e-6f, 1e-6f, 0};
    point.ng = point.ns = {0, 0, uv.x > 0.5f ? kNan : 1};
    point.dpdu = {2, 0, 0};
    point.uv = uv;
    return point;
  }
  float area(int) const override { return 4; }
  Vec2 sample_area(int, Vec2 u) const override { return u; }
};

std::vector<MadeShape> make_shape(ParamReader& reader) {
  reader.finish();
  std::vector<MadeShape> made;
  made.push_back({std::make_unique<HollowShape>(), std::nullopt});
  return made;
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(material_plugins(), {"hollow", "gives NaN where x is positive", make_material});
  registry.add(light_plugins(), {"hollow", "gives NaN to one side", make_light});
  registry.add(camera_plugins(), {"hollow", "gives NaN in the right half", make_camera});
  registry.add(shape_plugins(), {"hollow", "has no normal in its right half", make_shape});
}
