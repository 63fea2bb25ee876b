#include "dspm/world/objects/variations.h"

#include <algorithm>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/world/objects/params_at.h"

namespace dspm {
namespace {

const BlockSwitch* find_switch(const Variation& variation, const std::string& block) {
  const auto found = std::find_if(variation.switches.begin(), variation.switches.end(),
                                  [&](const BlockSwitch& each) { return each.block == block; });
  return found == variation.switches.end() ? nullptr : &*found;
}

/// Returns, for each variation of the axis, whether it shows the block.
std::vector<bool> shown_along(const VariationAxis& axis, const std::string& block) {
  const bool is_alternative = std::any_of(axis.variations.begin(), axis.variations.end(), [&](const Variation& each) {
    const BlockSwitch* const found = find_switch(each, block);
    return found != nullptr && found->shown;
  });
  std::vector<bool> shown;
  for (const Variation& each : axis.variations) {
    const BlockSwitch* const found = find_switch(each, block);
    shown.push_back(found != nullptr ? found->shown : !is_alternative);
  }
  return shown;
}

float scale_of(const LightScale& scale, Moment moment) {
  return numbers_of(*scale.params.at(moment).find("scale")).front();
}

/// Returns the product of the factors that the frame's variations give to lights of that name.
float factor_of(const SceneDescription& scene, const std::string& light, FileFrame frame) {
  float factor = 1;
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
    const auto choice = static_cast<std::size_t>(scene.frames.choice(frame, axis));
    for (const LightScale& scale : scene.axes[axis].variations[choice].lights)
      if (scale.light == light) factor *= scale_of(scale, scene.frames.moment(frame));
  }
  return factor;
}

/// Returns the one of the frame's variations that replaces the block by one of its own; null if there is none.
const Variation* replacer(const SceneDescription& scene, const std::string& block, FileFrame frame) {
  return replacement(scene.axes, scene.choices(frame), [&](const Variation& each) -> const Variation* {
    const auto& replaced = each.replaced_blocks;
    return std::find(replaced.begin(), replaced.end(), block) == replaced.end() ? nullptr : &each;
  });
}

bool is_replaced_somewhere(const SceneDescription& scene, const std::string& block) {
  return std::any_of(scene.axes.begin(), scene.axes.end(), [&](const VariationAxis& axis) {
    return std::any_of(axis.variations.begin(), axis.variations.end(), [&](const Variation& each) {
      return std::find(each.replaced_blocks.begin(), each.replaced_blocks.end(), block) != each.replaced_blocks.end();
    });
  });
}

/// Returns the variation whose block it is; null if it is the scene's.
const Variation* owner(const SceneDescription& scene, const DynamicBlock& block) {
  if (block.axis < 0 || block.axis >= static_cast<int>(scene.axes.size())) return nullptr;  // or after an error
  return &scene.axes[static_cast<std::size_t>(block.axis)].variations[static_cast<std::size_t>(block.variation)];
}

}  // namespace

std::vector<bool> presence(const SceneDescription& scene, int dynamic_block) {
  const FileFrames& frames = scene.frames;
  std::vector<bool> present(static_cast<std::size_t>(frames.count()), true);
  for (int b = dynamic_block; b >= 0; b = scene.dynamic_blocks[static_cast<std::size_t>(b)].outer) {
    const DynamicBlock& block = scene.dynamic_blocks[static_cast<std::size_t>(b)];
    for (FileFrame f(0); f.index() < frames.count(); ++f)
      if (!block.moments.contains(frames.whole_moment(f))) present[f.slot()] = false;
    if (is_replaced_somewhere(scene, block.name))
      for (FileFrame f(0); f.index() < frames.count(); ++f)
        if (replacer(scene, block.name, f) != owner(scene, block)) present[f.slot()] = false;
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
      const std::vector<bool> shown = shown_along(scene.axes[axis], block.name);
      for (FileFrame f(0); f.index() < frames.count(); ++f)
        if (!shown[static_cast<std::size_t>(frames.choice(f, axis))]) present[f.slot()] = false;
    }
  }
  return present;
}

ParamList light_params(const SceneDescription& scene, const PluginUse& use, const std::string& name, FileFrame frame) {
  ParamList params = use.blurs ? params_at(use.params, scene.frames, scene.frames.moment(frame))
                               : use.params.at(scene.frames.whole_moment(frame));
  const float factor = name.empty() ? 1 : factor_of(scene, name, frame);
  if (factor == 1) return params;
  auto scale = std::find_if(params.params.begin(), params.params.end(),
                            [](const Param& param) { return param.name == "scale"; });
  if (scale == params.params.end()) {
    Param one;
    one.name = "scale", one.values = std::vector<float>{1};
    one.where = one.values_where = use.where;
    scale = params.params.insert(scale, std::move(one));
  }
  if (scale->type != ParamType::number && scale->type != ParamType::integer) return params;  // its reader reports it
  std::vector<float> numbers = numbers_of(*scale);
  for (float& number : numbers) number *= factor;
  scale->type = ParamType::number, scale->values = std::move(numbers);
  return params;
}

}  // namespace dspm
