// The content of a scene's text, as plain data with source locations: no plugin is known here, no name is looked up.
// Frames count from 0. Lists are in the order of the text. Keys and motions depend on the moment of the animation
// alone.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/clock.h"
#include "dspm/lang/file_frames.h"
#include "dspm/lang/motion.h"

namespace dspm {

/// `"diffuse" "rgb reflectance" .5`: a plugin's name and its parameters, which already include the defaults of
/// `Attribute` (Param::is_default).
struct PluginUse {
  std::string type;
  ParamList params;
  SourceLocation where;       // of the directive's word
  SourceLocation type_where;  // of the quoted type
  bool blurs = true;          // false: while the shutter is open, it is as at the frame's own moment
};

struct CameraUse : PluginUse {
  Motion camera_from_world;   // as from pbrt's LookAt: maps world points to camera space
  int medium_interface = -1;  // see ShapeUse; the camera is outside
};

/// The options that dspm has: `Option "seed" 7` and the like.
struct SceneOptions {
  std::optional<int> seed;
  std::string numbers;  // even or independent; empty: what the sampler says
  std::string colour;   // rgb or spectral; empty: rgb
  bool disable_pixel_jitter = false;
  bool disable_texture_filtering = false;
  float displacement_edge_scale = 1;  // multiplies "edgelength" of every displaced mesh
};

struct MaterialUse : PluginUse {
  std::string name;  // of MakeNamedMaterial; empty for `Material`
};

/// The material in force: `Material` (an index), `NamedMaterial` (a name, which may be unknown) or neither, which means
/// pbrt's default, "diffuse".
struct MaterialRef {
  int index = -1;    // into SceneDescription::materials
  std::string name;  // of a NamedMaterial directive
  SourceLocation where;
};

struct TextureUse : PluginUse {  // `type` is the texture's class
  std::string name;
  bool is_spectrum = false;  // else float
  Motion world_from_texture;
};

struct LightUse : PluginUse {
  std::string name;  // of `"string name"`, removed from the parameters; empty: not given
  Motion world_from_light;
  int dynamic_block = -1;
  int medium_interface = -1;  // see ShapeUse; the light is outside
};

struct AreaLightUse : PluginUse {
  std::string name;
};

class ShapeRun;

struct ShapeUse : PluginUse {
  std::string name;  // of `"string name"`, removed from the parameters; empty: not given
  Motion world_from_object;
  bool reverse_orientation = false;
  MaterialRef material;
  int area_light = -1;        // into SceneDescription::area_lights; -1: none
  int dynamic_block = -1;     // into SceneDescription::dynamic_blocks; -1: static
  int medium_interface = -1;  // into SceneDescription::medium_interfaces; -1: the same medium on both sides
  /// The directives after it that repeat it except for numbers, see shape_run.h; null if there are none.
  std::shared_ptr<const ShapeRun> run = nullptr;
};

/// DynamicBegin .. DynamicEnd. In nested blocks, a shape belongs to the innermost.
struct DynamicBlock {
  std::string name;
  MomentInterval moments;  // those in which its shapes exist, within the enclosing block's
  SourceLocation where;
  int outer = -1;  // the enclosing block, into SceneDescription::dynamic_blocks
  // Of a block that stands in the place of the scene's of that name: whose it is.
  int axis = -1, variation = -1;
};

/// ObjectBegin .. ObjectEnd.
struct ObjectDefinition {
  std::string name;
  std::vector<ShapeUse> shapes;
  SourceLocation where;
};

/// Puts every shape of the definition at world_from_instance * shape.world_from_object, as pbrt does.
struct ObjectUse {
  std::string name;
  Motion world_from_instance;
  bool reverse_orientation = false;
  int dynamic_block = -1;
  SourceLocation where;
  bool blurs = true;  // as PluginUse's
};

struct MediumUse : PluginUse {
  std::string name;
  Motion world_from_medium;
};

/// The media, by name, inside and outside of the shapes that follow.
struct MediumInterfaceUse {
  std::string inside, outside;  // empty: vacuum
  SourceLocation where;

  bool parts() const { return inside != outside; }
};

/// `Light "key" "float scale" .5`: multiplies the strength of the lights of that name.
struct LightScale {
  std::string light;
  ParamList params;  // "scale", perhaps keyed
  SourceLocation where;
};

/// `Show "block"` or `Hide "block"`: shows or hides the Dynamic blocks of that name.
struct BlockSwitch {
  std::string block;
  bool shown;
  SourceLocation where;
};

/// VariationBegin .. VariationEnd. Its definitions replace the scene's.
struct Variation {
  std::string name;
  SourceLocation where;  // of the quoted name
  std::vector<MaterialUse> materials;
  std::vector<TextureUse> textures;
  std::vector<MediumUse> media;
  std::vector<LightScale> lights;
  std::vector<BlockSwitch> switches;
  std::vector<LightUse> light_sources;       // placed in the space of the light that they replace
  std::vector<AreaLightUse> area_lights;     // on the shapes of the one that they replace
  std::vector<std::string> replaced_blocks;  // by a Dynamic block of its own
  std::optional<CameraUse> camera;
  std::optional<PluginUse> integrator;
};

/// AxisBegin .. AxisEnd, or all variations outside such blocks.
struct VariationAxis {
  std::string name;  // empty: of the variations outside
  SourceLocation where;
  std::vector<Variation> variations;
};

/// `AxisExclude "steel" "red-*"` or `AxisOnly`: the combinations in which each pattern matches a choice.
struct CombinationRule {
  struct Pattern {
    int axis = -1;  // into SceneDescription::axes, once all are known; -1: any
    std::string text;
    SourceLocation where;
  };
  bool excludes;
  std::vector<Pattern> patterns;
  SourceLocation where;
};

/// `Plugin "libvelvet.so"`: a module with plugins.
struct ModuleUse {
  std::string file;
  SourceLocation where;
};

/// Returns what the last axis finds that has a definition of its own among the frame's variations; null if the scene's
/// holds.
template <class Find>
auto replacement(const std::vector<VariationAxis>& axes, const std::vector<int>& choices, Find&& find)
    -> decltype(find(axes.front().variations.front())) {
  for (std::size_t axis = axes.size(); axis-- > 0;)
    if (axis < choices.size())
      if (const auto found = find(axes[axis].variations[static_cast<std::size_t>(choices[axis])])) return found;
  return nullptr;
}

enum class Dialect { pbrt, dsc };  // by the main file's name; standard input counts as dsc

struct SceneDescription {
  std::vector<std::shared_ptr<const SourceFile>> files;  // the main file first; locations point into them
  Dialect dialect = Dialect::dsc;
  /// Returns where to look for files that are not next to the file that names them.
  std::filesystem::path main_directory() const {
    return files.empty() ? std::filesystem::path() : std::filesystem::path(files.front()->name).parent_path();
  }

  Moment first_moment;          // from `Frames`
  int moments = 1;              // likewise
  FileFrames frames;            // to be rendered: the product of moments and variations
  std::optional<double> fps;    // frames per second, if given
  SourceLocation frames_where;  // of the Frames directive; null file: none
  SceneOptions options;
  std::vector<ModuleUse> modules;
  std::optional<PluginUse> film, sampler, filter, integrator, accelerator;
  std::optional<CameraUse> camera;
  std::map<std::string, Motion> coordinate_systems;  // world from named system; "camera" and "world" among them

  std::vector<MaterialUse> materials;  // inline and named ones
  std::vector<TextureUse> textures;
  std::vector<LightUse> lights;
  std::vector<AreaLightUse> area_lights;
  std::vector<ShapeUse> shapes;
  std::vector<DynamicBlock> dynamic_blocks;
  std::vector<ObjectDefinition> objects;
  std::vector<ObjectUse> instances;
  std::vector<MediumUse> media;
  std::vector<MediumInterfaceUse> medium_interfaces;
  std::vector<VariationAxis> axes;
  std::vector<CombinationRule> rules;  // which combinations are left

  /// From the first frame to before the one after the last.
  MomentInterval all_moments() const { return {first_moment, Moment(first_moment.frames() + moments)}; }
  Clock clock() const { return {first_moment, fps}; }
  const std::vector<int>& choices(FileFrame frame) const {
    return frames.combinations()[frames.combination_of(frame)].choices;
  }
  /// Returns null if no camera is given.
  const CameraUse* camera_of(FileFrame frame) const {
    const CameraUse* own = replacement(
        axes, choices(frame), [](const Variation& v) -> const CameraUse* { return v.camera ? &*v.camera : nullptr; });
    return own != nullptr ? own : camera ? &*camera : nullptr;
  }
  /// Returns the integrator of one of the frame's variations; null if the scene's holds.
  const PluginUse* own_integrator_of(FileFrame frame) const {
    return replacement(axes, choices(frame),
                       [](const Variation& v) -> const PluginUse* { return v.integrator ? &*v.integrator : nullptr; });
  }
  /// Returns what replaces that light in the frame.
  const LightUse& light_of(const LightUse& light, FileFrame frame) const {
    return in_place_of(light, &Variation::light_sources, frame);
  }
  const AreaLightUse& light_of(const AreaLightUse& light, FileFrame frame) const {
    return in_place_of(light, &Variation::area_lights, frame);
  }

 private:
  template <class Use>
  const Use& in_place_of(const Use& light, std::vector<Use> Variation::*kind, FileFrame frame) const {
    if (light.name.empty()) return light;
    const Use* own = replacement(axes, choices(frame), [&](const Variation& v) -> const Use* {
      for (const Use& each : v.*kind)
        if (each.name == light.name) return &each;
      return nullptr;
    });
    return own != nullptr ? *own : light;
  }
};

}  // namespace dspm
