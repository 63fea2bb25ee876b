// Whole scenes made up from what the plugins say of their own parameters, so that a new plugin is in them as soon as it
// is in its table. Values are drawn blindly; what the plugins refuse is taken out, by the lines of their messages.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/session/modules/all_plugins.h"
#include "tests/integrators/scene_files.h"

namespace dspm::test {

/// A directive and its parameters, a line each.
struct DrawnDirective {
  std::string plugin;  // kind:name, or empty
  std::string head;
  std::vector<std::string> params = {};
  bool needs_medium = false;  // it goes when the medium goes
  bool is_plugin() const { return !plugin.empty(); }
};

class DescribedScene {
 public:
  enum class Light { any, furnace };  // furnace: radiance 1 from everywhere, and nothing else that shines

  explicit DescribedScene(unsigned seed, Light light = Light::any) : random_(seed), light_(light) {
    frames_ = whole(1, 4);
    add(fmt::format("Frames {}", frames_));
    use("integrator", "Integrator \"{}\"");
    has_catchers_ = directives_.back().plugin != "integrator:ambientocclusion" && chance(0.1);  // it refuses them
    const bool sees_media = may_see_media(directives_.back());
    if (chance(0.3)) use("accelerator", "Accelerator \"{}\"");
    use("filter", "PixelFilter \"{}\"");
    use("film", "Film \"{}\" \"integer xresolution\" 12 \"integer yresolution\" 8 \"string filename\" \"a.exr\"");
    add("LookAt 0 0.3 -4  0 0 0  0 1 0");
    use("camera", "Camera \"{}\"");
    add("WorldBegin");
    add("MakeNamedMaterial \"matte\" \"string type\" \"diffuse\"");
    add("MakeNamedMaterial \"metal\" \"string type\" \"conductor\" \"float roughness\" 0.1");
    for (int i = 0; i < kTextures; ++i) add_texture(i);
    add_lights();
    if (sees_media && chance(0.4)) add_medium();
    for (int i = whole(2, 5); i > 0; --i) add_thing(i);
    if (chance(0.3)) add_product();
  }

  std::string text() const {
    std::string text;
    for (const DrawnDirective& each : directives_) {
      text += each.head + "\n";
      for (const std::string& param : each.params) text += param + "\n";
    }
    return text;
  }

  /// Takes out what is wrong at that line of the text: the parameter, or all of a plugin's, or the plugin. False where
  /// that cannot be.
  bool take_out(int line) {
    for (auto each = directives_.begin(); each != directives_.end(); ++each) {
      const int lines = 1 + static_cast<int>(each->params.size());
      if (line > lines) {
        line -= lines;
        continue;
      }
      if (line > 1) return each->params.erase(each->params.begin() + line - 2), true;
      if (!each->is_plugin() && !each->needs_medium) return false;
      if (!each->params.empty()) return each->params.clear(), true;
      return directives_.erase(each), true;
    }
    return false;
  }

  /// The plugins in it: kind:name.
  std::vector<std::string> plugins() const {
    std::vector<std::string> names;
    for (const DrawnDirective& each : directives_)
      if (each.is_plugin()) names.push_back(each.plugin);
    return names;
  }

 private:
  static constexpr int kTextures = 3;
  static constexpr int kMost = 200;  // photons and the like: fewer than usual, for speed

  bool chance(double p) { return std::bernoulli_distribution(p)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(whole(0, static_cast<int>(all.size()) - 1))];
  }

  void add(const std::string& line) { directives_.push_back({{}, line}); }

  /// A plugin of that kind with some of its parameters; `{}` in the directive is its name.
  void use(const std::string& kind, const std::string& directive) {
    std::vector<CatalogueEntry> plugins = all_plugins();
    std::erase_if(plugins, [&](const CatalogueEntry& entry) { return entry.kind != kind; });
    const CatalogueEntry& plugin = one_of(plugins);
    points_ = plugin.name == "bilinearmesh" ? 4 : 3;
    DrawnDirective& drawn = directives_.emplace_back(
        DrawnDirective{kind + ":" + plugin.name, fmt::format(fmt::runtime(directive), plugin.name)});
    for (const ParamInfo& info : plugin.params()) {
      if (drawn.head.find(" " + info.name + "\"") != std::string::npos) continue;
      if (light_ == Light::furnace && (info.name == "emission" || info.name == "Le")) continue;
      if (info.name == "shadowcatcher" && !has_catchers_) continue;
      const bool needed = info.default_value == "required" || info.default_value.empty();
      if (needed || is_costly(info) || chance(0.4)) add_param(info, drawn);
    }
  }

  /// Photons and the like are always given, and valid: were they refused and taken out, the usual 300,000 would be
  /// traced.
  static bool is_costly(const ParamInfo& info) {
    return info.type == "integer" && std::atoi(info.default_value.c_str()) > kMost;
  }

  void add_param(const ParamInfo& info, DrawnDirective& drawn) {
    const std::string type = one_of(types_of(info));
    const std::optional<std::string> value = value_of(info, type);
    if (!value) return;
    const bool keyed = frames_ > 1 && type != "string" && type != "bool" && !is_costly(info) && chance(0.2);
    std::string line = fmt::format("  \"{} {}{}\" {}", type, info.name, keyed ? "@1" : "", *value);
    if (keyed) line += fmt::format(" \"{} {}@{}\" {}", type, info.name, frames_, *value_of(info, type));
    drawn.params.push_back(line);
  }

  /// "rgb, spectrum or texture"
  static std::vector<std::string> types_of(const ParamInfo& info) {
    std::vector<std::string> types;
    std::istringstream words(info.type);
    for (std::string word; words >> word;) {
      if (word.ends_with(',')) word.pop_back();
      if (word != "or") types.push_back(word);
    }
    return types;
  }

  std::optional<std::string> value_of(const ParamInfo& info, const std::string& type) {
    const bool list = info.default_value.empty();
    if (type == "bool") return chance(0.5) ? "true" : "false";
    if (type == "integer")
      return list ? (points_ == 4 ? "[0 1 2 3]" : "[0 1 2]")
                  : fmt::format("{}", is_costly(info) ? whole(1, kMost) : integer_near(info.default_value));
    if (type == "float") return list ? list_of(1, 4) : fmt::format("{:.6g}", number_near(info.default_value));
    if (type == "point2" || type == "vector2") return list_of(2, points_);
    if (type == "point3" || type == "vector3" || type == "normal") return list_of(3, list ? points_ : 1);
    if (type == "rgb") return fmt::format("[{:.3f} {:.3f} {:.3f}]", real(0, 1), real(0, 1), real(0, 1));
    if (type == "blackbody") return fmt::format("{:.0f}", real(1000, 9000));
    if (type == "spectrum")
      return fmt::format("[400 {:.3f} 550 {:.3f} 700 {:.3f}]", real(0, 1), real(0, 1), real(0, 1));
    if (type == "texture") return fmt::format("\"t{}\"", whole(0, kTextures - 1));
    if (!info.choices.empty()) return fmt::format("\"{}\"", one_of(info.choices));
    if (info.name == "materials") return "[\"matte\" \"metal\"]";
    if (info.sentence.find(".bsdf") != info.sentence.npos) return files()["ggx.bsdf"];
    if (info.name == "lensfile") return files()["pair.dat"];
    if (info.unit == "file")
      return files()[one_of<std::string>(
          {"picture.png", "square.exr", "sky.exr", "blob.001.ply", "blob.%03d.ply", "page.%02d.png", "box.obj"})];
    return std::nullopt;
  }

  /// Mostly something usual, at times something odd.
  double number_near(const std::string& usual) {
    const double value = std::strtod(usual.c_str(), nullptr);
    switch (whole(0, 9)) {
      case 0: return 0;
      case 1: return -value;
      case 2: return 1e-4;
      case 3: return 30;
      case 4: return value;
      default: return chance(0.5) ? value * real(0.3, 2) : real(0, 1);
    }
  }
  int integer_near(const std::string& usual) {
    return chance(0.5) ? whole(0, 4) : std::min(std::atoi(usual.c_str()), kMost);
  }
  std::string list_of(int size, int count) {
    std::string list = "[";
    for (int i = 0; i < size * count; ++i) list += fmt::format(" {:.3f}", real(-1, 1));
    return list + "]";
  }

  /// One that has colours and one that has numbers, of the same name.
  void add_texture(int i) {
    for (const char* values : {"float", "spectrum"})
      use("texture", fmt::format("Texture \"t{}\" \"{}\" \"{{}}\"", i, values));
  }

  void add_lights() {
    if (light_ == Light::furnace) return add("LightSource \"infinite\"");
    for (int i = whole(1, 2); i > 0; --i) {
      add(fmt::format("AttributeBegin Translate {:.2f} {:.2f} {:.2f}", real(-1, 1), real(0.5, 1.5), real(-2, 1)));
      use("light", "LightSource \"{}\"");
      add("AttributeEnd");
    }
  }

  static bool may_see_media(const DrawnDirective& integrator) {
    const auto leaves_them_out = [](const std::string& param) {
      return param.find("\"paths\"") != param.npos || param.find("finalgather") != param.npos;
    };
    return integrator.plugin != "integrator:ambientocclusion" &&
           std::none_of(integrator.params.begin(), integrator.params.end(), leaves_them_out);
  }

  /// A ball of a medium. Grids have values for each of their voxels.
  void add_medium() {
    use("medium", "MakeNamedMedium \"smoke\" \"string type\" \"{}\"");
    DrawnDirective& drawn = directives_.back();
    const auto gives = [&](const char* name) {
      return [name](const std::string& param) { return param.find(std::string(" ") + name + "\"") != param.npos; };
    };
    for (const char* name : {"nx", "ny", "nz", "density", "temperature", "Lescale"})
      if (drawn.plugin.ends_with("grid")) std::erase_if(drawn.params, gives(name));
    if (drawn.plugin == "medium:uniformgrid")
      drawn.head += " \"integer nx\" 2 \"integer nz\" 2 \"float density\" [0 1 .5 2]";
    directives_.push_back({{},
                           fmt::format("AttributeBegin MediumInterface \"smoke\" \"\" Material \"interface\" Translate "
                                       "{:.2f} {:.2f} {:.2f} Shape \"sphere\" \"float radius\" {:.2f} AttributeEnd",
                                       real(-1, 1), real(-1, 1), real(-1, 1), real(0.3, 2)),
                           {},
                           true});
  }

  /// Between keys no scale may pass through 0, so both mirror or none.
  std::string place(bool mirrors) {
    return fmt::format("Translate {:.2f} {:.2f} {:.2f} Rotate {:.0f} 1 {:.1f} 0 Scale {:.2f} {:.2f} {:.2f}",
                       real(-1, 1), real(-1, 1), real(-1, 1), real(0, 360), real(0, 1),
                       (mirrors ? -1 : 1) * real(0.3, 1.5), real(0.3, 1), real(0.3, 1));
  }

  /// A shape in its material, at rest or moving; perhaps it shines.
  void add_thing(int number) {
    const bool dynamic = chance(0.5);
    add(dynamic ? fmt::format("DynamicBegin \"d{}\"", number) : "AttributeBegin");
    const bool mirrors = chance(0.1);
    if (dynamic && frames_ > 1 && chance(0.7))
      add(fmt::format("Keyframe 1 {} Keyframe {} {} KeyframeEnd", place(mirrors), frames_, place(mirrors)));
    else
      add(place(mirrors));
    if (chance(0.1)) add("ReverseOrientation");
    use("material", "Material \"{}\"");
    if (light_ == Light::any && chance(0.2)) use("area light", "AreaLightSource \"{}\"");
    for (int i = whole(1, 2); i > 0; --i) use("shape", "Shape \"{}\"");
    add(dynamic ? "DynamicEnd" : "AttributeEnd");
  }

  /// A ball in two or three finishes.
  void add_product() {
    use("material", "MakeNamedMaterial \"finish\" \"string type\" \"{}\"");
    add("AttributeBegin NamedMaterial \"finish\" Shape \"sphere\" \"float radius\" 0.5 AttributeEnd");
    for (int i = whole(2, 3); i > 0; --i) {
      add(fmt::format("VariationBegin \"v{}\"", i));
      use("material", "MakeNamedMaterial \"finish\" \"string type\" \"{}\"");
      add("VariationEnd");
    }
  }

  static const SceneFiles& files() {
    static const SceneFiles all;
    return all;
  }

  std::mt19937 random_;
  Light light_;
  int frames_ = 1;
  bool has_catchers_ = false;
  int points_ = 3;  // of the plugin that is being drawn, if it has lists
  std::vector<DrawnDirective> directives_;
};

}  // namespace dspm::test
