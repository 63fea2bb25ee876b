// What a surface is made of. Plugins: diffuse.cpp is the shortest to copy; plugins.cpp is the table.
#pragma once

#include <memory>
#include <span>

#include "dspm/materials/bsdf.h"
#include "dspm/params/params.h"
#include "dspm/params/registry.h"
#include "dspm/shapes/shape.h"

namespace dspm {

class TextureSet;

class Material {
 public:
  virtual ~Material() = default;
  /// The Bsdf at a point, built in `slot`.
  virtual const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const = 0;
  /// Whether light enters the body: its mesh should then be closed and its normals point outward.
  virtual bool bounds_a_body() const { return false; }
};

struct MaterialContext {
  const TextureSet& textures;
};

using MakeMaterial = std::unique_ptr<Material>(ParamReader&, const MaterialContext&);
PluginTable<Plugin<MakeMaterial>>& material_plugins();

}  // namespace dspm
