// A material says how a surface scatters light. Plugins: diffuse.cpp, with diffuse_bsdf.h, is the shortest to copy;
// plugins.cpp is the table.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/materials/bsdf.h"
#include "dspm/materials/material_set.h"
#include "dspm/shapes/shape.h"

namespace dspm {

struct PlainIndex;
class PlainMaterial;
class Relief;
class TextureSet;

class Material {
 public:
  virtual ~Material() = default;
  /// Builds the Bsdf at a point in `slot`.
  virtual const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const = 0;
  /// Returns whether light enters the body: its mesh should then be closed and its normals should point outward.
  virtual bool bounds_a_body() const { return false; }
  /// The body's absorption coefficient, as paths carry it: after a distance d in the world, exp(-absorption d) of the light is left.
  virtual Spectrum absorption(const Palette&) const { return Spectrum(0); }
  /// The body's index of refraction, relative to the medium for which SurfacePoint::outside_eta is 1.
  virtual float eta() const { return 1; }
  /// The same for light of that wavelength.
  virtual float eta_at(const Wavelength&) const { return eta(); }
  /// Returns whether its index differs with the wavelength: light that it refracts goes on with one wavelength alone.
  virtual bool disperses() const { return false; }
  /// Returns whether light that crosses the surface is scattered inside.
  virtual bool scatters_inside() const { return false; }
  /// Returns false if light passes as if the surface were not there; its shapes are then left out of the scene.
  virtual bool is_seen() const { return true; }
  /// Returns which of its materials a mix, `depth` mixes deep, is made of at the point; null if the material is no mix.
  virtual const Material* chosen(const SurfacePoint& /*point*/, int /*depth*/) const { return nullptr; }

  /// The material that the point is made of: this one, unless it is a mix.
  const Material& at(const SurfacePoint& point) const {
    const Material* here = this;
    for (int depth = 0; const Material* next = here->chosen(point, depth); ++depth) here = next;
    return *here;
  }

  /// Returns whether f is linear in colours that average over a footprint (Texture::averages), and nothing else in it
  /// varies over the surface.
  virtual bool is_linear() const { return false; }
  /// Returns whether lookups over a footprint scatter what lookups at its points scatter on average. If not, bsdf() is
  /// never given a footprint: a rough or bumpy surface differs from one of mean roughness and height.
  bool averages() const { return is_linear() && relief_ == nullptr; }

  /// Returns what bends its normals, for any plugin; null if nothing does. Set once, when the material is made.
  const Relief* relief() const { return relief_.get(); }
  void set_relief(std::shared_ptr<const Relief> relief) { relief_ = std::move(relief); }

  /// The priority of the body, for any plugin: where bodies overlap, the one of the highest priority is there. Set
  /// once, when the material is made.
  int priority() const { return priority_; }
  void set_priority(int priority) { priority_ = priority; }

  /// Returns the material as paths of that palette see it, as a plain value, which a device can have. It has the Bsdfs of
  /// bsdf() wherever `outside` is around the body (see SurfacePoint::outside_eta) and there is no footprint. Returns nullopt if
  /// there is more to say: textures without a plain form, a relief, light that is scattered inside. The material and `outside`
  /// must outlive it.
  std::optional<PlainMaterial> plain(const Palette& palette, const PlainIndex& outside) const;
  /// The same where the index around the body is 1.
  std::optional<PlainMaterial> plain(const Palette& palette) const;

 private:
  /// plain() of a material without relief in whose body no light is scattered. A body overrides plain_within().
  virtual std::optional<PlainMaterial> plain_look(const Palette& palette) const;
  virtual std::optional<PlainMaterial> plain_within(const Palette& palette, const PlainIndex& outside) const;

  std::shared_ptr<const Relief> relief_;
  int priority_ = 0;
};

struct MaterialContext {
  const TextureSet& textures;
  const MaterialSet& materials = MaterialSet::none();  // those that the parameters name
  bool as_in_pbrt = false;                             // the scene is a .pbrt file: where pbrt loses light, so do we
};

using MakeMaterial = std::unique_ptr<Material>(ParamReader&, const MaterialContext&);
PluginTable<Plugin<MakeMaterial>>& material_plugins();

}  // namespace dspm
