#include "dspm/lang/canonical.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <variant>

#include "dspm/math/frames.h"
#include "dspm/params/params.h"
#include "dspm/system/files_read.h"

namespace dspm {
namespace {

/// Bytes that are equal if the values are.
class Canonical {
 public:
  Canonical& number(double value) { return text(fmt::format("{}", value)); }
  Canonical& text(const std::string& value) {
    bytes_ += fmt::format("{}:{},", value.size(), value);
    return *this;
  }
  Canonical& matrix(const Matrix4& matrix) {
    for (const auto& row : matrix.m)
      for (const double value : row) number(value);
    return *this;
  }
  Canonical& motion(const Motion& motion, int moments) {
    const int states = motion.is_keyed() ? moments : 1;
    for (int number = 1; number <= states; ++number) matrix(motion.at(Moment::numbered(number)));
    return *this;
  }
  Canonical& use(const std::string& type, const ParamList& params, const std::vector<std::string>& without = {}) {
    text(type).space(params.space);
    std::vector<const Param*> sorted;  // their order does not matter
    for (const Param& param : params.params)
      if (std::find(without.begin(), without.end(), param.name) == without.end()) sorted.push_back(&param);
    std::stable_sort(sorted.begin(), sorted.end(), [](const Param* a, const Param* b) {
      return std::tie(a->name, a->key) < std::tie(b->name, b->key);
    });
    for (const Param* param : sorted) this->param(*param);
    return *this;
  }
  Canonical& use(const PluginUse& use) { return this->use(use.type, use.params); }

  std::uint64_t digest() const { return dspm::digest(bytes_); }

 private:
  void param(const Param& param) {
    space(param.space);
    text(fmt::format("{} {}@{}", word_of(param.type), param.name, param.key ? param.key->frames() + 1 : 0));
    std::visit(
        [&](const auto& values) {
          for (const auto& value : values) this->value(value);
        },
        param.values);
  }
  void space(ColourSpace space) {
    if (space != ColourSpace::srgb) text(std::string(word_of(space)));
  }
  void value(const std::string& value) { text(value); }
  void value(double value) { number(value); }

  std::string bytes_;
};

class Digests {
 public:
  explicit Digests(const SceneDescription& scene) : scene_(scene) {}

  std::vector<ElementDigest> all() {
    add_frames();
    if (scene_.camera)
      add(named("camera", scene_.camera->type), scene_.camera->where,
          Canonical().use(*scene_.camera).motion(scene_.camera->camera_from_world, scene_.moments));
    for (const TextureUse& use : scene_.textures) add_texture(use);
    for (const MaterialUse& use : scene_.materials) add_material(use);
    for (const LightUse& use : scene_.lights)
      add(named("light", use.type), use.where,
          Canonical().use(use).text(use.name).motion(use.world_from_light, scene_.moments).number(use.dynamic_block));
    for (const AreaLightUse& use : scene_.area_lights)
      add(named("area light", use.type), use.where, Canonical().use(use).text(use.name));
    for (const ShapeUse& use : scene_.shapes) add(named("shape", use.type), use.where, of_shape(use));
    for (const DynamicBlock& block : scene_.dynamic_blocks)
      add(named("dynamic", block.name), block.where,
          Canonical().number(block.moments.first.frames()).number(block.moments.end.frames()).number(block.outer));
    add_objects();
    for (const VariationAxis& axis : scene_.axes)
      for (const Variation& variation : axis.variations) add_variation(axis, variation);
    return std::move(digests_);
  }

 private:
  static std::string named(const char* kind, const std::string& name) { return fmt::format("{} \"{}\"", kind, name); }

  void add(std::string name, const SourceLocation& where, const Canonical& canonical) {
    digests_.push_back({std::move(name), canonical.digest(), where});
  }

  void add_frames() {
    Canonical frames;
    frames.number(scene_.moments);
    for (const Combination& combination : scene_.frames.combinations()) frames.text(combination.name);
    add("the list of frames", scene_.frames_where, frames);
  }
  void add_texture(const TextureUse& use, const std::string& where = {}) {
    add(named("texture", use.name) + where, use.where,
        Canonical().use(use).number(use.is_spectrum).motion(use.world_from_texture, scene_.moments));
  }
  void add_material(const MaterialUse& use, const std::string& where = {}) {
    add(named("material", use.name.empty() ? use.type : use.name) + where, use.where,
        Canonical().use(use).text(use.name));
  }
  Canonical of_shape(const ShapeUse& use) const {
    return Canonical()
        .use(use)
        .text(use.name)
        .motion(use.world_from_object, scene_.moments)
        .number(use.reverse_orientation)
        .number(use.material.index)
        .text(use.material.name)
        .number(use.area_light)
        .number(use.dynamic_block);
  }
  void add_objects() {
    for (const ObjectDefinition& object : scene_.objects) {
      add(named("object", object.name), object.where, Canonical().number(static_cast<double>(object.shapes.size())));
      for (const ShapeUse& use : object.shapes)
        add(fmt::format("shape \"{}\" of object \"{}\"", use.type, object.name), use.where, of_shape(use));
    }
    for (const ObjectUse& use : scene_.instances)
      add(named("instance of", use.name), use.where,
          Canonical()
              .motion(use.world_from_instance, scene_.moments)
              .number(use.reverse_orientation)
              .number(use.dynamic_block));
  }
  void add_variation(const VariationAxis& axis, const Variation& variation) {
    Canonical own;
    own.text(axis.name);
    for (const LightScale& scale : variation.lights) own.use(scale.light, scale.params);
    for (const BlockSwitch& each : variation.switches) own.text(each.block).number(each.shown);
    const std::string name = named("variation", variation.name);
    add(name, variation.where, own);
    for (const TextureUse& use : variation.textures) add_texture(use, " of " + name);
    for (const MaterialUse& use : variation.materials) add_material(use, " of " + name);
  }

  const SceneDescription& scene_;
  std::vector<ElementDigest> digests_;
};

}  // namespace

std::vector<ElementDigest> digests_of(const SceneDescription& scene) { return Digests(scene).all(); }

std::uint64_t digest_of(const std::string& type, const ParamList& params, const std::vector<std::string>& without) {
  return Canonical().use(type, params, without).digest();
}

}  // namespace dspm
