#include "dspm/integrators/beside/shadow_catcher.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/beside/surface_outputs.h"
#include "dspm/integrators/beside/wrapping_integrator.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/photons/memory_needs.h"

namespace dspm {
namespace {

/// Returns what is left of the light E0, by the colour that loses most. Of spectral light, colours that are hardly there may be
/// negative: they are at least `least` of the brightest one, or do not count.
float share_left(const Rgb& with, const Rgb& without, float least) {
  float share = 1;
  const float floor = least * max_component(without);
  for (const auto& [e, e0] : {std::pair(with.r, without.r), {with.g, without.g}, {with.b, without.b}})
    if (e0 > floor) share = std::min(share, e / e0);
  return std::max(share, 0.f);
}

class ShadowCatcher final : public WrappingIntegrator {
 public:
  ShadowCatcher(std::unique_ptr<Integrator> with, std::unique_ptr<Integrator> without, bool spectral)
      : WrappingIntegrator(std::move(with)), without_(std::move(without)), least_(spectral ? 0.02f : 0) {}

  void iterate(const Iteration& iteration) override {
    inner_->iterate(iteration);
    const StepTimer timer(step_);
    std::vector<const Scene*> moments;
    for (const Scene* scene : iteration.moments) moments.push_back(scene->without_objects.get());
    without_->iterate({iteration.number, *iteration.scene.without_objects, iteration.delay, moments});
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> all = inner_->outputs();
    std::erase_if(all, [](const OutputInfo& output) { return output.name == kCaughtLight; });
    return all;
  }

  Image estimate(Frame frame, const std::string& output) const override {
    if (output != kRadiance && output != kAlphaOutput) return inner_->estimate(frame, output);
    Image image = inner_->estimate(frame, output);
    const Image caught = inner_->estimate(frame, kCaughtLight), share = inner_->estimate(frame, kCatcherOutput),
                caught_without = without_->estimate(frame, kCaughtLight),
                share_without = without_->estimate(frame, kCatcherOutput);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const float c = share.pixels[i].r, c0 = share_without.pixels[i].r;
      if (!(c > 0)) continue;
      const Rgb e0 = c0 > 0 ? caught_without.pixels[i] * (c / c0) : Rgb();  // as many paths as have found `caught`
      const float left = share_left(caught.pixels[i], e0, least_);
      image.pixels[i] += output == kRadiance ? caught.pixels[i] - e0 * left : Rgb(-c * left);
      // Of the colour that loses most, rounding may leave less than nothing.
      for (int channel = 0; channel < 3; ++channel) image.pixels[i][channel] = std::max(image.pixels[i][channel], 0.f);
    }
    return image;
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    statistics.steps.push_back(step_);
    statistics.bytes += without_->statistics().bytes;
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state) || !without_->persist(state)) return false;
    state.sum(step_.seconds);
    return true;
  }

 private:
  std::unique_ptr<Integrator> without_;
  float least_;  // see share_left()
  StepTime step_{"without objects"};
};

RenderSettings with_outputs(RenderSettings render, std::initializer_list<const char*> more) {
  for (const char* output : more)
    if (std::find(render.outputs.begin(), render.outputs.end(), output) == render.outputs.end())
      render.outputs.emplace_back(output);
  return render;
}

std::unique_ptr<Integrator> make_with_outputs(const MakeForScene& make, const Scene& scene,
                                              const RenderSettings& render, std::size_t memory) {
  return with_surface_outputs(
      [&](std::size_t bytes) {
        RenderSettings bounded = render;
        bounded.memory = bytes;
        return make(scene, bounded);
      },
      scene, render, memory);
}

}  // namespace

std::unique_ptr<Integrator> with_shadow_catchers(const MakeForScene& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory) {
  if (scene.without_objects == nullptr) return make_with_outputs(make, scene, render, memory);
  RenderSettings bare = render;
  bare.outputs.clear();
  try {
    auto with =
        make_with_outputs(make, scene, with_outputs(render, {kAlphaOutput, kCatcherOutput, kCaughtLight}), memory / 2);
    if (with == nullptr) return nullptr;
    auto without =
        make_with_outputs(make, *scene.without_objects, with_outputs(bare, {kCatcherOutput, kCaughtLight}), memory / 2);
    if (without == nullptr) return nullptr;
    return std::make_unique<ShadowCatcher>(std::move(with), std::move(without), render.spectral);
  } catch (NotEnoughMemory& error) {
    for (std::size_t* need :
         {&error.least.pixels, &error.least.hit_points, &error.least.photons, &error.least.learning})
      *need *= 2;
    throw;
  }
}

}  // namespace dspm
