#include "dspm/session/checkpoint/part_of_scene.h"

#include <algorithm>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

using Kind = ElementDigest::Kind;

bool has_file_materials(const std::vector<ShapeUse>& shapes) {
  return std::any_of(shapes.begin(), shapes.end(), [](const ShapeUse& use) { return use.type == "objmesh"; });
}

}  // namespace

PartOfScene::PartOfScene(const SceneDescription& scene, const FramesPart& part) : scene_(scene) {
  for (FileFrame f(0); f.index() < scene.frames.count(); ++f)
    if (scene.frames.contains(part, f)) frames_.push_back(f);
  for (std::size_t block = 0; block < scene.dynamic_blocks.size(); ++block) {
    const std::vector<bool> present = presence(scene, static_cast<int>(block));
    there_.push_back(std::any_of(frames_.begin(), frames_.end(), [&](FileFrame f) { return present[f.slot()]; }));
  }
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
    std::vector<bool>& chosen = chosen_.emplace_back(scene.axes[axis].variations.size());
    for (const FileFrame f : frames_) chosen[static_cast<std::size_t>(scene.frames.choice(f, axis))] = true;
  }
  for (const ObjectUse& use : scene.instances)
    if (is_there(use.dynamic_block)) objects_.insert(use.name);
  reads_materials_ = has_file_materials(scene.shapes);
  for (const ObjectDefinition& object : scene.objects) reads_materials_ |= has_file_materials(object.shapes);
}

bool PartOfScene::places(const ElementDigest& element) const {
  switch (element.kind) {
    case Kind::common: return true;
    case Kind::light:
    case Kind::shape:
    case Kind::instance: return is_there(element.dynamic_block);
    case Kind::object: return objects_.contains(element.object);
    case Kind::look:
    case Kind::block:
    case Kind::variation: return false;
  }
  return true;
}

bool PartOfScene::can_do_without(const ElementDigest& element) const {
  switch (element.kind) {
    case Kind::look: return !reads_materials_;
    case Kind::block: return !is_there(element.dynamic_block);
    case Kind::variation:
      return !chosen_[static_cast<std::size_t>(element.axis)][static_cast<std::size_t>(element.variation)];
    default: return !places(element);
  }
}

}  // namespace dspm
