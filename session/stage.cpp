#include "dspm/session/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/integrators/beside/error_estimate.h"
#include "dspm/integrators/beside/given_up.h"
#include "dspm/integrators/beside/shadow_catcher.h"
#include "dspm/integrators/beside/variance_output.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/session/job/output_choice.h"

namespace dspm {
namespace {

bool gives(const Integrator& integrator, const char* name) {
  const std::vector<OutputInfo> outputs = integrator.outputs();
  return std::any_of(outputs.begin(), outputs.end(), [&](const OutputInfo& output) { return output.name == name; });
}

/// Returns the settings of the scene's frames, which share them; null if they are the job's.
const Job::OwnIntegrator* own_integrator(const Job& job, const Scene& scene) {
  if (job.own_integrators.empty() || scene.file_frames.empty()) return nullptr;
  const PluginUse* const use = job.description->own_integrator_of(scene.file_frames.front());
  for (const Job::OwnIntegrator& own : job.own_integrators)
    if (own.use == use) return &own;
  return nullptr;
}

std::unique_ptr<Integrator> without_error(const Job& job, const Scene& scene, Diagnostics& diagnostics,
                                          std::size_t memory) {
  const auto make = [&](const Scene& of, const RenderSettings& bounded) {
    const Job::OwnIntegrator* const own = own_integrator(job, scene);
    ParamReader reader(own != nullptr ? own->params : job.params, fmt::format("integrator \"{}\"", job.plugin->name),
                       own != nullptr ? own->use->where : job.where, diagnostics);
    std::unique_ptr<Integrator> bare = job.plugin->make(reader, of, bounded);
    if (bare == nullptr || !has_catchers(of) || gives(*bare, kCaughtLight)) return bare;
    diagnostics.error(job.where, fmt::format("integrator \"{}\" knows no shadow catchers", job.plugin->name),
                      "dsppm, sppm, vcm, path and photonmap do");
    return std::unique_ptr<Integrator>();
  };
  const auto with_outputs = [&](std::size_t bytes) { return with_shadow_catchers(make, scene, job.settings, bytes); };
  std::unique_ptr<Integrator> made = with_variance_output(with_outputs, scene, job.settings, memory);
  if (made == nullptr && diagnostics.error_count() == 0)
    diagnostics.error(job.where,
                      fmt::format("integrator \"{}\" cannot be made: its factory returned null", job.plugin->name));
  if (made != nullptr) check_outputs(made->outputs(), job.settings.outputs, job.integrator, diagnostics);
  return made;
}

std::unique_ptr<Integrator> with_error(const Job& job, const MakeWithin& make, const Scene& scene, std::size_t memory) {
  const int marks_per_octave = job.until_error > 0 ? 8 : 2;  // each takes an image of every frame
  return with_error_estimate(make, scene, job.settings.crop, marks_per_octave, memory);
}

}  // namespace

Stage::Stage(const Job& job, const World& world, FrameList frames)
    : job_(job), frames_(std::move(frames)), scene_(world.scene(frames_)), exposure_(job, world, *scene_) {}

Integrator& Stage::make_integrator(Messages& messages, const StageSettings& settings) {
  integrator_.reset();
  const auto make_one = [&](std::size_t memory) {
    Diagnostics diagnostics;
    std::unique_ptr<Integrator> made = without_error(job_, *scene_, diagnostics, memory);
    messages.show(diagnostics);
    diagnostics.throw_if_errors();
    return made;
  };
  const auto make = [&](std::size_t memory) {
    std::unique_ptr<Integrator> made = make_one(memory);
    return settings.share_out ? settings.share_out(std::move(made), make_one(memory)) : std::move(made);
  };
  integrator_ =
      without_given_up(settings.sees_all ? with_error(job_, make, *scene_, settings.memory) : make(settings.memory),
                       static_cast<int>(frames_.size()), settings.given_up);
  return *integrator_;
}

std::unique_ptr<Integrator> make_integrator(const Job& job, const Scene& scene, Diagnostics& diagnostics,
                                            std::size_t memory) {
  const auto make = [&](std::size_t bytes) { return without_error(job, scene, diagnostics, bytes); };
  return with_error(job, make, scene, memory);
}

}  // namespace dspm
