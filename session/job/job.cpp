#include "dspm/session/job/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/flag.h"
#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/readable.h"
#include "dspm/session/job/frame_choice.h"
#include "dspm/session/job/integrator_choice.h"
#include "dspm/session/job/output_choice.h"
#include "dspm/session/job/sampler.h"
#include "dspm/shapes/shadow_catcher.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

bool asks_for_shadow_catchers(const SceneDescription& description) {
  const auto asks = [](const ShapeUse& use) { return is_true(use.params, kShadowCatcherParam); };
  return std::any_of(description.shapes.begin(), description.shapes.end(), asks) ||
         std::any_of(description.objects.begin(), description.objects.end(), [&](const ObjectDefinition& object) {
           return std::any_of(object.shapes.begin(), object.shapes.end(), asks);
         });
}

/// Returns pbrt's paths per pixel for a scene written for it that names none.
int usual_samples(const SceneDescription& description) {
  if (description.dialect != Dialect::pbrt) return RenderSettings().default_iterations;
  return description.sampler && description.sampler->type == "independent" ? 4 : 16;
}

/// Makes the object that a directive before WorldBegin asks for, or one of the usual type.
template <class Make>
auto make_one(const PluginTable<Plugin<Make>>& plugins, const char* usual, const std::optional<PluginUse>& use,
              Diagnostics& diagnostics) {
  static const PluginUse kNone;
  const PluginUse& used = use ? *use : kNone;
  const std::string& name = use ? use->type : usual;
  const Plugin<Make>* plugin = plugins.find(name, used.type_where, diagnostics);
  const bool replaced = plugin == nullptr;
  if (replaced) plugin = &plugins.front();
  const ParamList& params = replaced ? kNone.params : used.params;
  ParamReader reader(params, fmt::format("{} \"{}\"", plugins.kind(), plugin->name), used.where, diagnostics);
  return plugin->make(reader);
}

/// Checks a plugin's weights, which may be anything.
void expect_density(const PixelFilter& filter, const SceneDescription& description, Diagnostics& diagnostics) {
  constexpr int kSteps = 4096;
  const Vec2 radius = filter.radius();
  bool is_density = radius.x > 0 && radius.y > 0 && std::isfinite(radius.x) && std::isfinite(radius.y);
  for (int i = 0; i <= kSteps && is_density; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / (kSteps + 1), place = 2 * static_cast<float>(i) / kSteps - 1;
    const Vec2 drawn = filter.sample({u, u});
    const auto is_sound = [](float density) { return density >= 0 && std::isfinite(density); };
    is_density = std::abs(drawn.x) <= radius.x && std::abs(drawn.y) <= radius.y &&
                 is_sound(filter.density({place * radius.x, 0})) && is_sound(filter.density({0, place * radius.y}));
  }
  if (is_density) return;
  const PluginUse& use = description.filter ? *description.filter : PluginUse();
  const Plugin<MakePixelFilter>* plugin = pixel_filter_plugins().find(use.type);
  const bool is_of_module = plugin != nullptr && !plugin->origin.empty();
  diagnostics.error(
      use.where, fmt::format("{} \"{}\"{} has weights that are negative or not finite", pixel_filter_plugins().kind(),
                             use.type, is_of_module ? fmt::format(" of {}", plugin->origin) : ""));
}

void check_crop(const FilmSettings& film, const SceneDescription& description, Diagnostics& diagnostics) {
  const PixelRect crop = crop_of(film);
  if (crop.empty())
    throw UsageError(fmt::format("the crop leaves nothing of the image of {} x {} pixels", film.width, film.height));
  if (crop.width() > static_cast<int>(kMaxPixels) / crop.height())
    diagnostics.error(description.film ? description.film->where : SourceLocation(),
                      fmt::format("{} x {} pixels are more than the {} million that an image may have", crop.width(),
                                  crop.height(), kMaxPixels / 1'000'000),
                      "--cropwindow renders a part of it");
}

FilmSettings resized(const FilmSettings& film, const Resolution& wanted) {
  if (wanted.share > 0) return scaled(film, wanted.share);
  return scaled(film, wanted.width, wanted.height);
}

FilmSettings make_film(const SceneDescription& description, const Choices& choices, Diagnostics& diagnostics) {
  const int errors = diagnostics.error_count();
  FilmSettings film = *make_one(film_plugins(), "rgb", description.film, diagnostics);
  if (choices.resolution) film = resized(film, *choices.resolution);
  if (choices.quick) film = scaled(film, 1. / kQuickShare);
  if (!choices.outfile.empty()) film.filename = choices.outfile;
  if (choices.half) film.save_half = *choices.half;
  if (choices.crop_window) {
    film.crop_window.emplace();
    std::copy(choices.crop_window->begin(), choices.crop_window->end(), film.crop_window->begin());
  } else if (choices.pixel_bounds) {
    film.crop_window.reset();
    film.pixel_bounds = choices.pixel_bounds;
  }
  if (diagnostics.error_count() == errors) check_crop(film, description, diagnostics);
  return film;
}

float number_of(const ParamList& list, std::string_view name, float fallback) {
  const Param* param = list.find(name);
  const auto* values = param != nullptr ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  return values != nullptr && values->size() == 1 ? values->front() : fallback;
}

/// Returns the seconds for which pbrt's film is exposed; dspm's shutter, in frames, changes no brightness.
float shutter_seconds(const SceneDescription& description) {
  if (description.dialect == Dialect::dsc || !description.camera) return 1;
  const ParamList params = description.camera->params.at(Moment());
  const float seconds = number_of(params, "shutterclose", 1) - number_of(params, "shutteropen", 0);
  return seconds > 0 ? seconds : 1;
}

/// Returns whether vertices of a mesh may have velocities, which only its file knows.
bool may_have_velocities(const SceneDescription& description) {
  const auto may_move = [&](const ShapeUse& use) {
    return use.type == "plymesh" &&
           (description.dialect == Dialect::dsc || use.params.find("velocityscale") != nullptr);
  };
  const auto any_moves = [&](const std::vector<ShapeUse>& uses) {
    return std::any_of(uses.begin(), uses.end(), may_move);
  };
  return any_moves(description.shapes) ||
         std::any_of(description.objects.begin(), description.objects.end(),
                     [&](const ObjectDefinition& object) { return any_moves(object.shapes); });
}

/// Returns the command line's shutter, else the camera's; a closed one if nothing can move.
Shutter shutter_of(const SceneDescription& description, const Choices& choices, Diagnostics& diagnostics) {
  const Shutter of_camera = shutter_of(description, diagnostics);
  const Shutter wanted = choices.shutter ? Shutter{0, *choices.shutter} : of_camera;
  return what_moves(description).empty() && !may_have_velocities(description) ? Shutter{} : wanted;
}

/// Returns the command line's accelerator, else the scene's if dspm has it; pbrt's trees change nothing in the image.
std::string accel_of(const SceneDescription& description, const Choices& choices, Diagnostics& diagnostics) {
  if (!choices.accel.empty()) return std::string(find_by_option(accel_plugins(), "accel", choices.accel)->name);
  const std::optional<PluginUse>& use = description.accelerator;
  if (!use) return {};
  if (use->type != "bvh" && use->type != "kdtree") {
    const auto* plugin = accel_plugins().find(use->type, use->type_where, diagnostics);
    return plugin != nullptr ? use->type : std::string();
  }
  diagnostics.note(use->where, fmt::format("accelerator \"{}\" has no effect: dspm has its own", use->type));
  return {};
}

/// Reports errors in the integrator's parameters before there is a scene to make it for.
void check_integrator(const Job& job, const ParamList& params, const SourceLocation& where, Diagnostics& diagnostics) {
  ParamReader reader(params, fmt::format("integrator \"{}\"", job.integrator), where, diagnostics);
  check(*job.plugin, reader, Scene{}, job.settings);
}

/// Adds the settings that variations give. One integrator renders all frames.
void add_own_integrators(const SceneDescription& description, const Choices& choices, Job& job,
                         Diagnostics& diagnostics) {
  for (const VariationAxis& axis : description.axes)
    for (const Variation& variation : axis.variations) {
      if (!variation.integrator) continue;
      const PluginUse& use = *variation.integrator;
      IntegratorChoice choice = choose_integrator(description, choices, diagnostics, &use);
      for (const char* const name : {"seed", "noise"})
        if (const Param* const param = choice.params.find(name))
          diagnostics.error(param->where, fmt::format("the {} is the same for all variations", name));
      if (choice.plugin != nullptr && choice.plugin != job.plugin)
        diagnostics.error(use.type_where, "the integrator's type is the same for all variations",
                          fmt::format("the scene's is \"{}\"; other settings of it are possible", job.integrator));
      else if (choice.plugin != nullptr)
        check_integrator(job, choice.params, use.where, diagnostics);
      job.own_integrators.push_back({&use, std::move(choice.params)});
    }
}

/// Returns the noise that the command line asks for, else the integrator, else the sampler.
std::string noise_of(const Job& job, const SamplerSettings& sampler, const Choices& choices) {
  if (!choices.noise.empty()) return choices.noise;
  const std::string* const own = only_text(job.params.find("noise"));
  return own != nullptr ? *own : sampler.noise;
}

Device device_of(const Choices& choices) {
  if (choices.device == "waves") return Device::waves;
  if (choices.device == "gpu") return Device::gpu;
  return choices.device == "auto" ? Device::automatic : Device::cpu;
}

/// Says that the integrator knows the CPU only.
void refuse_device(Job& job, Diagnostics& diagnostics) {
  if (job.settings.device == Device::automatic)
    diagnostics.note(job.where, fmt::format("the integrator {} renders on the CPU: --device auto has no effect",
                                            job.integrator));
  else
    diagnostics.error(job.where, fmt::format("the integrator {} traces no photons in waves", job.integrator),
                      "--device waves and --device gpu are for dsppm and sppm");
  job.settings.device = Device::cpu;
}

}  // namespace

std::string Job::frames_in_words() const {
  std::set<std::size_t> variations;
  for (const FileFrame frame : frames) variations.insert(description->frames.combination_of(frame));
  if (description->axes.empty()) return counted(frames.size(), "frame");
  const std::string in_words = counted(variations.size(), "variation");
  return numbered ? fmt::format("{} ({})", counted(frames.size(), "frame"), in_words) : in_words;
}

int Job::iterations(const Integrator& made) const {
  if (chosen_iterations) return *chosen_iterations;
  if (until_error > 0) return 0;
  const int asked = made.iterations();
  return quick && asked > 0 ? std::max(1, asked / kQuickShare) : asked;
}

Job make_job(const SceneDescription& description, const Choices& choices, Diagnostics& diagnostics) {
  Job job;
  job.scene_file = description.files.empty() ? "-" : description.files.front()->name;
  job.description = &description;
  job.frames = chosen_frames(description, choices);
  job.known = choices.known;
  job.numbered = description.frames_where.file != nullptr;
  job.fps = description.fps.value_or(0);
  job.film = make_film(description, choices, diagnostics);
  job.film.transparent |= choices.transparent || asks_for_shadow_catchers(description);
  job.exposure = imaging_ratio(job.film, shutter_seconds(description));
  job.shutter = shutter_of(description, choices, diagnostics);

  IntegratorChoice choice = choose_integrator(description, choices, diagnostics);
  job.plugin = choice.plugin;
  job.integrator = choice.plugin != nullptr ? choice.plugin->name : "";
  job.params = std::move(choice.params);
  job.where = choice.where;

  job.accel = accel_of(description, choices, diagnostics);
  job.chosen_iterations = choices.iterations, job.quick = choices.quick;
  job.until_error = choices.until_error;

  const SamplerSettings sampler = read_sampler(description.sampler, diagnostics);
  RenderSettings& settings = job.settings;
  settings.width = job.film.width, settings.height = job.film.height;
  settings.crop = crop_of(job.film);
  settings.filter = make_one(pixel_filter_plugins(), kUsualPixelFilter, description.filter, diagnostics);
  expect_density(*settings.filter, description, diagnostics);
  job.outputs = outputs_of(job.film, choices, description), job.denoiser = choices.denoiser;
  settings.outputs = with_denoiser_inputs(job.outputs, job.denoiser);
  settings.in_camera_space = job.film.in_camera_space;
  expect_room(job.film, job.outputs, description);
  settings.transparent = job.film.transparent;
  settings.jitter = !description.options.disable_pixel_jitter;
  settings.filter_textures = !description.options.disable_texture_filtering;
  settings.default_iterations = sampler.pixel_samples.value_or(usual_samples(description));
  const int seed = sampler.seed.value_or(description.options.seed.value_or(0));
  settings.seed = choices.seed.value_or(static_cast<std::uint64_t>(integer_of(job.params, "seed", seed)));
  const std::string& numbers = description.options.numbers;
  settings.independent_numbers = numbers.empty() ? sampler.independent_numbers : numbers == "independent";
  const std::string& colour = choices.colour.empty() ? description.options.colour : choices.colour;
  settings.spectral = colour.empty() ? job.film.spectral : colour == "spectral";
  if (job.film.sensor != nullptr && !settings.spectral)
    diagnostics.note(
        description.film ? description.film->where : SourceLocation{},
        "the film's sensor responds to wavelengths, so it has no effect in RGB; --colour spectral has them");
  settings.device = device_of(choices);
  settings.noise_per_frame = noise_of(job, sampler, choices) == "perframe";
  if (job.plugin != nullptr) {
    if (settings.device != Device::cpu && !job.plugin->traces_waves) refuse_device(job, diagnostics);
    check_integrator(job, job.params, job.where, diagnostics);
    add_own_integrators(description, choices, job, diagnostics);
  }
  return job;
}

}  // namespace dspm
