#include "dspm/integrators/waves/plain_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "dspm/accel/two_level.h"
#include "dspm/base/colour/spectral_curve.h"
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

constexpr PlainDiffuse kUnused{};  // no shape is made of it, or the scene would not be plain

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
  shape.body = scene.body_of(placed.material);
  shape.emits = placed.light >= 0, shape.catches_shadows = scene.is_catcher(static_cast<int>(index));
  if (placed.cutout != nullptr) shape.alpha = &alphas.emplace_back(*placed.cutout->plain());
  shape.cutout_key = placed.cutout_key;
  return shape;
}

/// Returns what keeps the shape's material from being plain.
std::string why_not_plain(const Scene& scene, const PlacedShape& shape) {
  const FrameStates<Material>& material = scene.materials[static_cast<std::size_t>(shape.material)];
  if (scene.body_of(shape.material) != kNoBody && only_state(material, scene.frames()) == nullptr)
    return "the body " + name_of(scene, shape) + " differs between frames";
  for (const auto& [frames, state] : material.states) {
    if (state->scatters_inside()) return "light is scattered inside " + name_of(scene, shape);
    if (!state->plain(*scene.palette))
      return "the material of " + name_of(scene, shape) + " is none of the plain kinds";
  }
  return {};
}

}  // namespace

std::vector<std::string> reasons_not_plain(const Scene& scene) {
  std::vector<std::string> reasons;
  const auto add = [&](std::string reason) {
    if (!reason.empty() && std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(std::move(reason));
  };
  if (!scene.media.empty()) add("there are media");
  if (dynamic_cast<const TwoLevel*>(scene.accel.get()) == nullptr) add("the accelerator is not \"two-level\"");
  for (const PlacedShape& shape : scene.shapes) {
    if (first_not_plain({&shape, 1}) >= 0) add(name_of(scene, shape) + " is none of the plain kinds");
    if (shape.cutout != nullptr && !shape.cutout->plain())
      add(name_of(scene, shape) + " has holes by a texture that has no plain form");
    add(why_not_plain(scene, shape));
  }
  return reasons;
}

std::string why_not_plain(const Scene& scene) {
  const std::vector<std::string> reasons = reasons_not_plain(scene);
  return reasons.empty() ? "" : reasons.front();
}

bool looks_differ(const Scene& scene) {
  return std::ranges::any_of(scene.shapes, [&](const PlacedShape& shape) {
    return scene.materials[static_cast<std::size_t>(shape.material)].differs_in(scene.frames());
  });
}

PlainObjects::PlainObjects(const Scene& scene) : trees_(dynamic_cast<const TwoLevel&>(*scene.accel)) {
  shapes_.reserve(scene.shapes.size());
  for (std::size_t shape = 0; shape < scene.shapes.size(); ++shape) shapes_.push_back(plain(scene, shape, alphas_));
  find_bodies(scene);
  for (std::size_t around = 0; around < surroundings_.size(); ++around)
    for (std::size_t m = 0; m < scene.materials.size(); ++m) materials_.push_back(plain_material(scene, m, around));
  add_states(scene);
  plain_ = {.query = trees_.query(),
            .shapes = shapes_.data(),
            .materials = materials_.data(),
            .states = states_.data(),
            .bodies = {bodies_.data(), bodies_.size()},
            .surroundings = surroundings_.data(),
            .shape_count = shapes_.size(),
            .material_count = scene.materials.size(),
            .surroundings_count = surroundings_.size(),
            .state_count = states_.size()};
}

void PlainObjects::find_bodies(const Scene& scene) {
  surroundings_.push_back({});
  if (scene.bounds_bodies.empty()) return;
  for (const FrameStates<Material>& material : scene.materials) {
    PlainBody& body = bodies_.emplace_back();
    const Material* const state = only_state(material, scene.frames());
    if (state == nullptr || !state->bounds_a_body()) continue;
    body.is_one = true, body.rank = state->priority(), body.absorption = state->absorption(*scene.palette);
    if (scene.nests) body.surroundings = surroundings_of(*state);
  }
}

int PlainObjects::surroundings_of(const Material& body) {
  std::vector<float> by_nm;
  for (int nm = kFirstNm; body.disperses() && nm <= kLastNm; ++nm)
    by_nm.push_back(body.eta_at({.nm = static_cast<std::int16_t>(nm)}));
  for (std::size_t i = 0; i < surroundings_.size(); ++i)
    if (surroundings_[i].mean == body.eta() && by_nm_[i] == by_nm) return static_cast<int>(i);
  const std::vector<float>& kept = by_nm_.emplace_back(std::move(by_nm));
  surroundings_.push_back({body.eta(), kept.empty() ? nullptr : kept.data()});
  return static_cast<int>(surroundings_.size()) - 1;
}

PlainMaterial PlainObjects::plain_material(const Scene& scene, std::size_t material, std::size_t around) const {
  const Material* const state = only_state(scene.materials[material], scene.frames());
  if (state == nullptr) return kUnused;
  const bool may_be_there = around == 0 || may_lie_within(material, around);
  return state->plain(*scene.palette, surroundings_[may_be_there ? around : 0]).value_or(kUnused);
}

void PlainObjects::add_states(const Scene& scene) {
  states_.resize(materials_.size());
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (only_state(scene.materials[m], scene.frames()) != nullptr) continue;
    std::size_t place = m;
    for (const auto& [frames, state] : scene.materials[m].states) {
      if (!states_[place].frames.empty()) {
        states_[place].next = materials_.size();
        place = materials_.size();
        materials_.push_back(kUnused), states_.emplace_back();
      }
      materials_[place] = state->plain(*scene.palette).value_or(kUnused), states_[place].frames = frames;
    }
  }
}

/// Bodies make tables for what is around them, so it is worth a question.
bool PlainObjects::may_lie_within(std::size_t material, std::size_t around) const {
  const PlainBody& inner = bodies_[material];
  const bool is_light = std::ranges::any_of(
      shapes_, [&](const PlainPlacedShape& shape) { return shape.emits && shape.body == static_cast<int>(material); });
  return inner.is_one && std::ranges::any_of(bodies_, [&](const PlainBody& outer) {
           const bool is_there = inner.rank > outer.rank || (is_light && inner.rank != outer.rank);
           return outer.is_one && outer.surroundings == static_cast<int>(around) && is_there;
         });
}

}  // namespace dspm
