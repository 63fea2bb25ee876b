#include "dspm/lang/canonical.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <variant>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/files_read.h"
#include "dspm/lang/shape_run.h"

namespace dspm {
namespace {

/// Collects bytes that are equal if the values are.
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
  Canonical& motion(const Motion& motion, const MomentInterval& moments) {
    for (Moment moment = moments.first; moment < moments.end; moment = Moment(moment.frames() + 1)) {
      matrix(motion.at(moment));
      if (!motion.is_keyed()) break;
    }
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
  Canonical& media(const SceneDescription& scene, int interface) {
    if (interface < 0) return *this;
    const MediumInterfaceUse& use = scene.medium_interfaces[static_cast<std::size_t>(interface)];
    return use.inside.empty() && use.outside.empty() ? *this : text("media").text(use.inside).text(use.outside);
  }
  Canonical& use(const PluginUse& use) { return this->use(use.type, use.params).blur(use.blurs); }
  /// Usual ones are as they were before there were others.
  Canonical& blur(bool blurs) { return blurs ? *this : text("sharp"); }

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
  using Kind = ElementDigest::Kind;

  Digests(const SceneDescription& scene, const FramesPart& part)
      : scene_(scene), moments_{scene.first_moment, Moment(scene.first_moment.frames() + part.moments)} {}

  std::vector<ElementDigest> all() {
    add_frames();
    if (scene_.camera)
      add(named("camera", scene_.camera->type), scene_.camera->where,
          Canonical()
              .use(*scene_.camera)
              .motion(scene_.camera->camera_from_world, moments_)
              .media(scene_, scene_.camera->medium_interface));
    for (const MediumUse& use : scene_.media) add_medium(use);
    for (const TextureUse& use : scene_.textures) add_texture(use);
    for (const MaterialUse& use : scene_.materials) add_material(use);
    for (const LightUse& use : scene_.lights)
      add(named("light", use.type), use.where,
          Canonical()
              .use(use)
              .text(use.name)
              .motion(use.world_from_light, moments_)
              .number(use.dynamic_block)
              .media(scene_, use.medium_interface),
          Kind::light, use.dynamic_block);
    for (const AreaLightUse& use : scene_.area_lights)
      add(named("area light", use.type), use.where, Canonical().use(use).text(use.name), Kind::look);
    for_each_directive(scene_.shapes, [&](const ShapeUse& use) {
      add(named("shape", use.type), use.where, of_shape(use), Kind::shape, use.dynamic_block);
    });
    add_blocks();
    add_objects();
    for (std::size_t axis = 0; axis < scene_.axes.size(); ++axis)
      for (std::size_t v = 0; v < scene_.axes[axis].variations.size(); ++v) add_variation(axis, v);
    return std::move(digests_);
  }

 private:
  static std::string named(const char* kind, const std::string& name) { return fmt::format("{} \"{}\"", kind, name); }

  void add(std::string name, const SourceLocation& where, const Canonical& canonical, Kind kind = Kind::common,
           int dynamic_block = -1) {
    digests_.push_back({std::move(name), canonical.digest(), where, kind, dynamic_block});
  }

  /// Adds the number of moments, but not which variations there are: a run may go on with more or fewer.
  void add_frames() {
    Canonical frames;
    frames.number(moments_.end.frames() - moments_.first.frames());
    if (moments_.first != Moment()) frames.number(moments_.first.frames());
    add("the number of frames", scene_.frames_where, frames);
  }
  void add_texture(const TextureUse& use, const std::string& where = {}) {
    add(named("texture", use.name) + where, use.where,
        Canonical().use(use).number(use.is_spectrum).motion(use.world_from_texture, moments_), Kind::look);
  }
  void add_material(const MaterialUse& use, const std::string& where = {}) {
    add(named("material", use.name.empty() ? use.type : use.name) + where, use.where,
        Canonical().use(use).text(use.name), Kind::look);
  }
  void add_medium(const MediumUse& use, const std::string& where = {}) {
    add(named("medium", use.name) + where, use.where,
        Canonical().use(use).text(use.name).motion(use.world_from_medium, moments_));
  }
  void add_blocks() {
    for (std::size_t i = 0; i < scene_.dynamic_blocks.size(); ++i) {
      const DynamicBlock& block = scene_.dynamic_blocks[i];
      const double end = std::min(block.moments.end, moments_.end).frames();
      add(named("dynamic", block.name), block.where,
          Canonical().number(block.moments.first.frames()).number(end).number(block.outer), Kind::block,
          static_cast<int>(i));
    }
  }
  Canonical of_shape(const ShapeUse& use) const {
    return Canonical()
        .use(use)
        .text(use.name)
        .motion(use.world_from_object, moments_)
        .number(use.reverse_orientation)
        .number(use.material.index)
        .text(use.material.name)
        .number(use.area_light)
        .number(use.dynamic_block)
        .media(scene_, use.medium_interface);
  }
  void add_objects() {
    for (const ObjectDefinition& object : scene_.objects) {
      add(named("object", object.name), object.where,
          Canonical().number(static_cast<double>(count_directives(object.shapes))), Kind::object);
      digests_.back().object = object.name;
      for_each_directive(object.shapes, [&](const ShapeUse& use) {
        add(fmt::format("shape \"{}\" of object \"{}\"", use.type, object.name), use.where, of_shape(use),
            Kind::object);
        digests_.back().object = object.name;
      });
    }
    for (const ObjectUse& use : scene_.instances) {
      add(named("instance of", use.name), use.where,
          Canonical()
              .motion(use.world_from_instance, moments_)
              .number(use.reverse_orientation)
              .number(use.dynamic_block)
              .blur(use.blurs),
          Kind::instance, use.dynamic_block);
      digests_.back().object = use.name;
    }
  }
  void add_variation(std::size_t axis_index, std::size_t index) {
    const VariationAxis& axis = scene_.axes[axis_index];
    const Variation& variation = axis.variations[index];
    const std::size_t first = digests_.size();
    Canonical own;
    own.text(axis.name);
    for (const LightScale& scale : variation.lights) own.use(scale.light, scale.params);
    for (const BlockSwitch& each : variation.switches) own.text(each.block).number(each.shown);
    const std::string name = named("variation", variation.name);
    add(name, variation.where, own);
    if (variation.camera)
      add(named("camera", variation.camera->type) + " of " + name, variation.camera->where,
          Canonical().use(*variation.camera).motion(variation.camera->camera_from_world, moments_));
    if (const std::optional<PluginUse>& use = variation.integrator)
      add(named("integrator", use->type) + " of " + name, use->where,
          Canonical().use(use->type, use->params, {"iterations"}));
    for (const LightUse& use : variation.light_sources)
      add(named("light", use.name) + " of " + name, use.where,
          Canonical().use(use).text(use.name).motion(use.world_from_light, moments_));
    for (const AreaLightUse& use : variation.area_lights)
      add(named("area light", use.name) + " of " + name, use.where, Canonical().use(use).text(use.name));
    for (const TextureUse& use : variation.textures) add_texture(use, " of " + name);
    for (const MaterialUse& use : variation.materials) add_material(use, " of " + name);
    for (const MediumUse& use : variation.media) add_medium(use, " of " + name);
    for (std::size_t i = first; i < digests_.size(); ++i) {
      digests_[i].kind = Kind::variation;
      digests_[i].axis = static_cast<int>(axis_index), digests_[i].variation = static_cast<int>(index);
    }
  }

  const SceneDescription& scene_;
  const MomentInterval moments_;
  std::vector<ElementDigest> digests_;
};

}  // namespace

std::vector<ElementDigest> digests_of(const SceneDescription& scene, const FramesPart& part) {
  return Digests(scene, part).all();
}

std::uint64_t digest_of(const std::string& type, const ParamList& params, const std::vector<std::string>& without) {
  return Canonical().use(type, params, without).digest();
}

}  // namespace dspm
