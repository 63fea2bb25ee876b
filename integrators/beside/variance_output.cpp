#include "dspm/integrators/beside/variance_output.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/integrators/beside/wrapping_integrator.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {
namespace {

OutputInfo variance_info() {
  OutputInfo info{kVarianceOutput,
                  {"variance.R", "variance.G", "variance.B"},
                  "estimated variance of the pixel's radiance, (W/(m^2 sr))^2"};
  info.single = true;
  return info;
}

class VarianceOutput final : public WrappingIntegrator {
 public:
  VarianceOutput(std::unique_ptr<Integrator> inner, int frames, const PixelRect& crop)
      : WrappingIntegrator(std::move(inner)),
        crop_(crop),
        frames_(frames),
        means_(bytes(frames, crop) / (2 * sizeof(Rgb))),
        squares_(means_.size()) {}
  static std::size_t bytes(int frames, const PixelRect& crop) {
    return 2 * sizeof(Rgb) * static_cast<std::size_t>(frames) * static_cast<std::size_t>(crop.count());
  }

  void iterate(const Iteration& iteration) override {
    inner_->iterate(iteration);
    ++done_;
    const StepTimer timer(step_);
    parallel_for(frames_, 1, [&](std::int64_t f) { add(inner_->estimate(static_cast<Frame>(f), kRadiance), f); });
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> all = inner_->outputs();
    all.push_back(variance_info());
    return all;
  }

  Image estimate(Frame frame, const std::string& output) const override {
    if (output != kVarianceOutput) return inner_->estimate(frame, output);
    Image image(crop_.width(), crop_.height());
    if (done_ < 2) return image;
    const float share = 1 / (static_cast<float>(done_) * static_cast<float>(done_ - 1));
    const Rgb* const squares = &squares_[first(frame)];
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = squares[i] * share;
    return image;
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    statistics.steps.push_back(step_);
    statistics.bytes += (means_.size() + squares_.size()) * sizeof(Rgb);
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state)) return false;
    state.sum(step_.seconds);
    if (state.merges()) return merge(state);
    state.value(done_);
    state.value(means_);
    state.value(squares_);
    expect_iterations(done_);
    for (const Rgb& c : squares_) expect_possible(!(c.r < 0 || c.g < 0 || c.b < 0), "its variance");
    return true;
  }

 private:
  /// Takes in another part's iterations, as if this one had done them. [Chan et al. 1979]
  bool merge(StateStream& part) {
    const int done = done_;
    const std::vector<Rgb> means = means_, squares = squares_;
    part.value(done_);
    part.value(means_);
    part.value(squares_);
    const int both = done + done_;
    if (both == 0) return true;
    const float theirs = static_cast<float>(done_) / static_cast<float>(both),
                weight = static_cast<float>(done) * theirs;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Rgb apart = means_[i] - means[i];
      means_[i] = means[i] + apart * theirs;
      squares_[i] += squares[i] + apart * apart * weight;
    }
    done_ = both;
    return true;
  }
  std::size_t first(std::int64_t frame) const {
    return static_cast<std::size_t>(frame) * static_cast<std::size_t>(crop_.count());
  }

  void add(const Image& image, std::int64_t frame) {
    if (image.pixels.size() != static_cast<std::size_t>(crop_.count())) return;  // refused when it is to be written
    const float weight = static_cast<float>(done_) * static_cast<float>(done_ - 1);
    Rgb *const means = &means_[first(frame)], *const squares = &squares_[first(frame)];
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const Rgb change = image.pixels[i] - means[i];
      squares[i] += change * change * weight;
      means[i] = image.pixels[i];
    }
  }

  PixelRect crop_;
  int frames_, done_ = 0;
  std::vector<Rgb> means_, squares_;  // by frame and pixel
  StepTime step_{"variance"};
};

}  // namespace

// A bound on memory has room for a copy: iterations that are cancelled are reverted to one.
std::unique_ptr<Integrator> with_variance_output(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory) {
  if (std::find(render.outputs.begin(), render.outputs.end(), kVarianceOutput) == render.outputs.end())
    return make(memory);
  std::unique_ptr<Integrator> inner =
      make_beside(2 * VarianceOutput::bytes(scene.frame_count(), render.crop), make, memory);
  if (inner == nullptr) return nullptr;
  const std::vector<OutputInfo> own = inner->outputs();
  if (std::any_of(own.begin(), own.end(), [](const OutputInfo& output) { return output.name == kVarianceOutput; }))
    return inner;
  return std::make_unique<VarianceOutput>(std::move(inner), scene.frame_count(), render.crop);
}

}  // namespace dspm
