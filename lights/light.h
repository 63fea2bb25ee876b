// Sources of light. Every light emits photons and can be sampled directly. Plugins: point.cpp is the shortest to copy;
// plugins.cpp is the table.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "dspm/base/colour/colour.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/lights/emission.h"
#include "dspm/lights/light_bounds.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

class Light {
 public:
  virtual ~Light() = default;
  /// The total flux in W, or a good estimate of it: lights are chosen in proportion to it.
  virtual Rgb power() const = 0;
  /// Where light leaves from, and which way: of many lights, those that matter at a point are chosen by it. Returns
  /// nullopt if it is not known, or infinitely far away.
  virtual std::optional<LightBounds> bounds() const { return std::nullopt; }
  /// Starts a photon path; nullopt if these numbers yield no light. Numbers that are close should give starts that are
  /// close: integrators learn which boxes of numbers are worth drawing from.
  virtual std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const = 0;
  /// The densities with which emit() draws this start and direction, for paths that came to the light another way;
  /// `normal` and `primitive` are those of Emission. A delta counts as matched. A density is 0 if it is unknown or if
  /// emit() never draws this.
  virtual EmissionPdf pdf_emit(const Ray& /*start*/, const Vec3& /*normal*/, int /*primitive*/) const { return {}; }
  /// The numbers with which emit() draws this start and direction, up to rounding. A number is kAnyNumber if it does
  /// not matter or is not known: a method that learns which numbers to draw then weights by the mean density over it.
  virtual EmissionNumbers emission_numbers(const Ray& /*start*/, const Vec3& /*normal*/, int /*primitive*/) const {
    return {kAnyNumber, kAnyNumber, kAnyNumber, kAnyNumber};
  }
  /// Samples a direction from which p may be lit; nullopt if these numbers yield no light.
  virtual std::optional<Illumination> illuminate(const Vec3& p, Vec2 u) const = 0;
  /// Announces that illuminate() will soon be called with this u, for lights that then wait for memory.
  virtual void prefetch(Vec2 /*u*/) const {}

  /// Returns the colour by which this light differs from `other`, this one over the other, if they differ in nothing
  /// else at any place and in any direction: photons of both then start alike. Returns nullopt if they differ
  /// otherwise, or if it is not known.
  virtual std::optional<Rgb> ratio_to(const Light& other) const {
    return this == &other ? std::optional(Rgb(1)) : std::nullopt;
  }

  /// Returns whether photons of this light may start as `other` samples them, with weights of at most kMostWeight times
  /// those that this light itself would give.
  virtual bool starts_like(const Light& other) const { return ratio_to(other).has_value(); }
  /// If starts_like(other), the flux of this light for such a photon over the flux of `other`.
  virtual Rgb ratio_along(const Light& other, const Ray& /*start*/) const { return ratio_to(other).value_or(Rgb()); }
  static constexpr float kMostWeight = 2;

  /// The spectrum whose colour the colours of this light are multiples of, for any plugin; null if none was given. Set once,
  /// when the light is made.
  const std::shared_ptr<const SpectrumByNm>& spectrum() const { return spectrum_; }
  void set_spectrum(std::shared_ptr<const SpectrumByNm> spectrum) { spectrum_ = std::move(spectrum); }
  /// Returns what paths carry of a colour that the light gave.
  Spectrum carried(const Rgb& colour, const Palette& palette) const { return palette.light(colour, spectrum_.get()); }
  /// What paths carry of background(), which may be of another colour.
  Spectrum carried_background(const Ray& ray, const Palette& palette) const {
    const Rgb seen = background(ray);
    return spectrum_ != nullptr && seen != escaped(ray) ? palette.light(seen) : carried(seen, palette);
  }

  /// The radiance that leaves the light's own surface at `point` in direction w (area lights).
  virtual Rgb emitted(const SurfacePoint&, const Vec3& /*w*/) const { return {}; }
  /// The density by solid angle with which illuminate(from) samples that point of the light's primitive.
  virtual float pdf_w(const Vec3& /*from*/, const SurfacePoint&, int /*primitive*/) const { return 0; }
  /// Returns whether rays that leave the scene see the light; if so, it implements escaped() and escaped_pdf_w().
  virtual bool is_infinite() const { return false; }
  /// The radiance along a ray that leaves the scene (infinite lights). escaped_pdf_w() returns the density with which
  /// illuminate() at the ray's origin draws its direction.
  virtual Rgb escaped(const Ray& /*ray*/) const { return {}; }
  /// What the camera sees along a ray that has met nothing: the picture's background, which need not be the light.
  virtual Rgb background(const Ray& ray) const { return escaped(ray); }
  virtual float escaped_pdf_w(const Ray& /*ray*/) const { return 0; }

 private:
  std::shared_ptr<const SpectrumByNm> spectrum_;
};

/// The input of a light besides its parameters.
struct LightContext {
  Transform to_world;
  Vec3 scene_center;  // the sphere around everything, over all frames of the file
  float scene_radius = 1;
  const PlacedShape* shape = nullptr;  // of an area light; outlives the light
  bool hidden = false;                 // no ray can meet the shape, but its light is there
};

using MakeLight = std::unique_ptr<Light>(ParamReader&, const LightContext&);
PluginTable<Plugin<MakeLight>>& light_plugins();       // LightSource
PluginTable<Plugin<MakeLight>>& area_light_plugins();  // AreaLightSource

}  // namespace dspm
