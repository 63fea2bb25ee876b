// What a surface is made of. Plugins: diffuse.cpp is the shortest to copy; plugins.cpp is the table.
#pragma once

#include <memory>
#include <span>

#include "dspm/colour/rgb.h"
#include "dspm/materials/bsdf.h"
#include "dspm/materials/material_set.h"
#include "dspm/params/params.h"
#include "dspm/params/registry.h"
#include "dspm/shapes/shape.h"

namespace dspm {

class Relief;
class TextureSet;

class Material {
 public:
  virtual ~Material() = default;
  /// The Bsdf at a point, built in `slot`.
  virtual const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const = 0;
  /// Whether light enters the body: its mesh should then be closed and its normals point outward.
  virtual bool bounds_a_body() const { return false; }
  /// What the body absorbs: over a distance d in the world, exp(-absorption d) of the light is left.
  virtual Rgb absorption() const { return Rgb(0); }
  /// The body's index of refraction, over that of what SurfacePoint::outside_eta is 1 for.
  virtual float eta() const { return 1; }
  /// Whether light that crosses the surface is scattered inside.
  virtual bool scatters_inside() const { return false; }
  /// False: light passes as if the surface were not there, so its shapes are left out of the scene.
  virtual bool is_seen() const { return true; }
  /// Of a mix, `depth` mixes deep: which of its materials the point is made of. Null: this one.
  virtual const Material* chosen(const SurfacePoint& /*point*/, int /*depth*/) const { return nullptr; }

  /// The material that the point is made of: this one, unless it is a mix.
  const Material& at(const SurfacePoint& point) const {
    const Material* here = this;
    for (int depth = 0; const Material* next = here->chosen(point, depth); ++depth) here = next;
    return *here;
  }

  /// Whether f is linear in colours that average over a footprint (Texture::averages), and nothing else of it varies over
  /// the surface.
  virtual bool is_linear() const { return false; }
  /// Whether lookups over a footprint scatter what lookups at its points scatter on average. bsdf() of others is never
  /// given one: a rough or bumpy surface is another one than that of mean roughness and height.
  bool averages() const { return is_linear() && relief_ == nullptr; }

  /// What bends its normals, whatever the plugin; null: nothing. Set once, when the material is made.
  const Relief* relief() const { return relief_.get(); }
  void set_relief(std::shared_ptr<const Relief> relief) { relief_ = std::move(relief); }

  /// Of the body, whatever the plugin: where bodies overlap, the one of the highest priority is there. Set once, when the
  /// material is made.
  int priority() const { return priority_; }
  void set_priority(int priority) { priority_ = priority; }

 private:
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
