#include "dspm/lang/factors.h"

#include <algorithm>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

template <class Things, class Moves>
bool any_moves(const Things& things, Moves&& moves) {
  return std::any_of(things.begin(), things.end(), moves);
}

bool shape_moves(const ShapeUse& use) { return use.world_from_object.is_keyed() || use.params.is_keyed(); }

/// Returns whether the parameter places a light. All other keyed parameters describe how strongly it shines, and in
/// which directions.
bool places_a_light(const Param& param) { return param.key && (param.name == "from" || param.name == "to"); }

bool moments_move_paths(const SceneDescription& scene) {
  const MomentInterval all{Moment(), Moment(scene.moments)};
  return (scene.camera && (scene.camera->camera_from_world.is_keyed() || scene.camera->params.is_keyed())) ||
         any_moves(scene.dynamic_blocks, [&](const DynamicBlock& block) { return !(block.moments == all); }) ||
         any_moves(scene.shapes, shape_moves) ||
         any_moves(scene.objects,
                   [](const ObjectDefinition& object) { return any_moves(object.shapes, shape_moves); }) ||
         any_moves(scene.instances, [](const ObjectUse& use) { return use.world_from_instance.is_keyed(); }) ||
         any_moves(scene.lights, [](const LightUse& use) {
           return use.world_from_light.is_keyed() || any_moves(use.params.params, places_a_light);
         });
}

}  // namespace

std::vector<Factor> factors_of(const SceneDescription& scene) {
  std::vector<Factor> factors{{Factor::kMoments, moments_move_paths(scene)}};
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis)
    factors.push_back({static_cast<int>(axis), any_moves(scene.axes[axis].variations, [](const Variation& variation) {
                         return !variation.switches.empty() || !variation.replaced_blocks.empty() ||
                                !variation.light_sources.empty() || variation.camera;
                       })});
  return factors;
}

int place_along(const Factor& factor, const FileFrames& frames, FileFrame frame) {
  return factor.axis == Factor::kMoments ? frames.moment_index(frame)
                                         : frames.choice(frame, static_cast<std::size_t>(factor.axis));
}

}  // namespace dspm
