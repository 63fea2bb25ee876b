#include "dspm/integrators/waves/plain_objects.h"

#include <fmt/format.h>

#include "dspm/accel/two_level.h"
#include "dspm/base/math/frames.h"
#include "dspm/shapes/cutout.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

std::string name_of(const Scene& scene, const PlacedShape& shape) {
  if (shape.object < 0) return "a shape";
  return fmt::format("the shape \"{}\"", scene.object_names[static_cast<std::size_t>(shape.object)]);
}

/// Returns the material in its one state; null if it has several, or is not there in all frames.
const Material* only_state(const FrameStates<Material>& material, FrameSet all) {
  return material.states.size() == 1 && material.states[0].frames.contains(all) ? material.states[0].object.get()
                                                                                : nullptr;
}

/// `alphas` keeps the texture of its holes.
PlainPlacedShape plain(const Scene& scene, std::size_t index, std::deque<PlainTexture<float>>& alphas) {
  const PlacedShape& placed = scene.shapes[index];
  PlainPlacedShape shape;
  if (const TriangleMesh* mesh = placed.shape->triangles())
    shape.mesh = mesh->view();
  else
    shape.shape = *placed.shape->plain();
  shape.to_world = placed.to_world, shape.in_object_space = placed.in_object_space();
  shape.flips_normals = placed.flip_normals, shape.caustics = placed.caustics, shape.material = placed.material;
  shape.emits = placed.light >= 0, shape.catches_shadows = scene.is_catcher(static_cast<int>(index));
  if (placed.cutout != nullptr) shape.alpha = &alphas.emplace_back(*placed.cutout->plain());
  shape.cutout_key = placed.cutout_key;
  return shape;
}

}  // namespace

std::string why_not_plain(const Scene& scene) {
  if (!scene.media.empty()) return "there are media";
  if (!scene.bounds_bodies.empty())
    return "light passes through bodies that absorb or scatter it, or lie in one another";
  if (dynamic_cast<const TwoLevel*>(scene.accel.get()) == nullptr) return "the accelerator is not \"two-level\"";
  if (const int s = first_not_plain(scene.shapes); s >= 0)
    return name_of(scene, scene.shapes[static_cast<std::size_t>(s)]) + " is none of the plain kinds";
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.cutout != nullptr && !shape.cutout->plain())
      return name_of(scene, shape) + " has holes by a texture that has no plain form";
    const Material* const material =
        only_state(scene.materials[static_cast<std::size_t>(shape.material)], scene.frames());
    if (material == nullptr) return "the material of " + name_of(scene, shape) + " differs between frames";
    if (!material->plain(*scene.palette))
      return "the material of " + name_of(scene, shape) + " is none of the plain kinds";
  }
  return {};
}

PlainObjects::PlainObjects(const Scene& scene) : trees_(dynamic_cast<const TwoLevel&>(*scene.accel)) {
  shapes_.reserve(scene.shapes.size());
  for (std::size_t shape = 0; shape < scene.shapes.size(); ++shape) shapes_.push_back(plain(scene, shape, alphas_));
  materials_.reserve(scene.materials.size());
  for (const FrameStates<Material>& material : scene.materials) {
    const Material* const state = only_state(material, scene.frames());
    constexpr PlainDiffuse kUnused{};  // no shape is made of it, or the scene would not be plain
    materials_.push_back(state == nullptr ? kUnused : state->plain(*scene.palette).value_or(kUnused));
  }
  plain_ = {trees_.query(), shapes_.data(), materials_.data(), shapes_.size(), materials_.size()};
}

}  // namespace dspm
