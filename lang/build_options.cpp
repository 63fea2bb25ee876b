// Directives before WorldBegin: frames, camera, film and the like; options and colour space may also come later.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/described_options.h"
#include "dspm/lang/scene_builder.h"

namespace dspm {
namespace {

using enum DirectiveKind;

std::vector<std::string> option_names() {
  std::vector<std::string> names;
  for (const ParamInfo& option : described_options()) names.push_back(option.name);
  return names;
}
/// Options that change pbrt's noise, its reports or how it computes, but not what its image converges to.
constexpr std::string_view kOptionsWithoutEffect[] = {"disablewavelengthjitter", "msereferenceimage", "msereferenceout",
                                                      "rendercoordsys",          "pixelstats",        "wavefront"};

bool is_without_effect(std::string_view option) {
  return std::find(std::begin(kOptionsWithoutEffect), std::end(kOptionsWithoutEffect), option) !=
         std::end(kOptionsWithoutEffect);
}

/// Returns nullopt if the whole text is not a number of that type.
template <class T>
std::optional<T> number_of(const std::string& text) {
  T number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

/// Removes case, dashes and underscores, which pbrt ignores in the names of options.
std::string normalized(std::string_view name) {
  std::string result;
  for (const char c : name)
    if (c != '-' && c != '_') result.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return result;
}

}  // namespace

const std::vector<ParamInfo>& described_options() {
  static const std::vector<ParamInfo> options = {
      {"integer", "seed", "0", "",
       "of the random numbers; --seed takes precedence, then the integrator's, the sampler's"},
      {"string", "numbers", "even", "",
       "even: random numbers that cover what paths sample more evenly than independent ones do; or independent. It "
       "goes "
       "before the sampler"},
      {"string", "colour", "rgb", "",
       "rgb: paths carry red, green and blue; spectral: three wavelengths in each iteration, other ones each time"},
      {"bool", "disablepixeljitter", "false", "", "camera paths go through the middles of pixels"},
      {"bool", "disabletexturefiltering", "false", "", "textures are looked up at points, not over footprints"},
      {"float", "displacementedgescale", "1", "", "times \"edgelength\" of displaced meshes"},
  };
  return options;
}

bool SceneBuilder::apply_option(Directive& directive) {
  switch (directive.info->kind) {
    case film: set_plugin(scene_.film, directive); return true;
    case sampler: set_plugin(scene_.sampler, directive); return true;
    case pixel_filter: set_plugin(scene_.filter, directive); return true;
    case integrator: set_plugin(scene_.integrator, directive); return true;
    case accelerator: set_plugin(scene_.accelerator, directive); return true;
    case DirectiveKind::camera: camera(directive); return true;
    case DirectiveKind::frames: frames(directive); return true;
    case DirectiveKind::option: option(directive); return true;
    case DirectiveKind::color_space: color_space(directive); return true;
    case DirectiveKind::world_begin: world_begin(directive.where); return true;
    case DirectiveKind::plugin:
      scene_.modules.push_back({directive.words[0].text, directive.words[0].where});
      return true;
    case DirectiveKind::transform_times: transform_times(directive); return true;
    default: return false;
  }
}

void SceneBuilder::warn_of_second(const Directive& directive, const PluginUse* first) {
  if (first == nullptr || (scene_is_whole_ && first->where.file != directive.where.file)) return;
  diagnostics_.warning(directive.where, fmt::format("this {} replaces the one on {}", directive.info->name,
                                                    place_of(first->where, directive.where)));
}

void SceneBuilder::set_plugin(std::optional<PluginUse>& slot, Directive& directive) {
  warn_of_second(directive, slot ? &*slot : nullptr);
  slot = plugin_use(directive);
}

void SceneBuilder::camera(Directive& directive) {
  warn_of_second(directive, scene_.camera ? &*scene_.camera : nullptr);
  const Motion place = scene_is_whole_ ? place_of_replacing_camera() : state_.ctm.of_camera(transform_times_);
  scene_.camera = CameraUse{plugin_use(directive), place, state_.medium_interface};
  scene_.coordinate_systems["camera"] = place.inverse();
  if (scene_is_whole_) state_.ctm = {};
}

void SceneBuilder::transform_times(const Directive& directive) {
  transform_times_ = {Moment(directive.numbers[0]), Moment(directive.numbers[1])};
  if (transform_times_.start < transform_times_.end) return;
  diagnostics_.error(directive.where, "the second time of TransformTimes must be after the first");
  transform_times_ = {};
}

/// Returns the place of a camera that replaces another. Without a transform before it, it is another lens at the place
/// of the other camera.
Motion SceneBuilder::place_of_replacing_camera() const {
  const Motion own = state_.ctm.of_camera(transform_times_);
  return scene_.camera && own == Motion() ? scene_.camera->camera_from_world : own;
}

void SceneBuilder::frames(const Directive& directive) {
  if (scene_.frames_where.file != nullptr) {
    diagnostics_.error(directive.where, "a second Frames directive",
                       fmt::format("the first is on {}", place_of(scene_.frames_where, directive.where)));
    return;
  }
  scene_.frames_where = directive.where;
  const double count = directive.numbers[0];
  if (count >= 1 && count <= kMostFrames && count == std::floor(count))
    scene_.moments = static_cast<int>(count);
  else
    diagnostics_.error(directive.where, fmt::format("expected a number of frames from 1 to {}", kMostFrames));
  ParamReader reader(directive.params, "Frames", directive.where, diagnostics_);
  const float fps = reader.number("fps", 0, "1/s", "frames per second");
  const int first = reader.integer("first", 1, "", "the number of the first frame");
  reader.finish();
  if (first >= 0 && first <= kLastFrame - scene_.moments + 1)
    scene_.first_moment = Moment::numbered(first);
  else
    reader.error("first", fmt::format("frames have numbers from 0 to {}", kLastFrame));
  if (!reader.has("fps")) return;
  if (!(fps > 0)) reader.error("fps", "the frames per second must be greater than 0");
  scene_.fps = fps;
}

void SceneBuilder::option(const Directive& directive) {
  const Argument &name = directive.words[0], &value = directive.words[1];
  const std::string known = normalized(name.text);
  if (known == "seed") {
    const auto seed = number_of<int>(value.text);
    if (!seed) diagnostics_.error(value.where, "expected an integer");
    scene_.options.seed = seed.value_or(0);
  } else if (known == "numbers") {
    if (value.text != "even" && value.text != "independent")
      return diagnostics_.error(value.where, "expected \"even\" or \"independent\"");
    scene_.options.numbers = value.text;
  } else if (known == "colour" || known == "color") {
    if (value.text != "rgb" && value.text != "spectral")
      return diagnostics_.error(value.where, "expected \"rgb\" or \"spectral\"");
    scene_.options.colour = value.text;
  } else if (known == "displacementedgescale") {
    const float scale = number_of<float>(value.text).value_or(0);
    if (!(scale > 0 && scale < kInfinity)) return diagnostics_.error(value.where, "expected a number above 0");
    scene_.options.displacement_edge_scale = scale;
  } else if (known == "disablepixeljitter" || known == "disabletexturefiltering") {
    if (value.text != "true" && value.text != "false") diagnostics_.error(value.where, "expected true or false");
    (known == "disablepixeljitter" ? scene_.options.disable_pixel_jitter : scene_.options.disable_texture_filtering) =
        value.text == "true";
  } else if (is_without_effect(known)) {
    diagnostics_.note(name.where, fmt::format("Option \"{}\" has no effect on the image", name.text));
  } else if (known == "forcediffuse") {
    if (value.text == "false") return;
    diagnostics_.unsupported(name.where, fmt::format("dspm has no Option \"{}\"", name.text),
                             "with --lenient, it has no effect");
  } else {
    const std::vector<std::string> names = option_names();
    const std::string guess = did_you_mean(known, names);
    diagnostics_.error(name.where, fmt::format("unknown Option \"{}\"", name.text),
                       guess.empty() ? fmt::format("available: {}", fmt::join(names, ", ")) : guess);
  }
}

void SceneBuilder::color_space(const Directive& directive) {
  const Argument& name = directive.words[0];
  const std::optional<ColourSpace> space = colour_space(name.text);
  if (space) return void(state_.space = *space);
  const std::string guess = did_you_mean(name.text, colour_space_words());
  const std::string all = fmt::format("available: {}", fmt::join(colour_space_words(), ", "));
  diagnostics_.error(name.where, fmt::format("unknown ColorSpace \"{}\"", name.text),
                     guess.empty() ? all : fmt::format("{} {}", guess, all));
}

}  // namespace dspm
