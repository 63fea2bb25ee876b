#include "dspm/integrators/beside/variance_output.h"

#include <algorithm>
#include <bit>
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
        means_(static_cast<std::size_t>(frames) * static_cast<std::size_t>(crop.count())),
        squares_(means_.size()),
        half_(means_.size()),
        evenness_(means_.size(), 1.f) {}
  static std::size_t bytes(int frames, const PixelRect& crop) {
    return (3 * sizeof(Rgb) + sizeof(float)) * static_cast<std::size_t>(frames) *
           static_cast<std::size_t>(crop.count());
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
    const std::size_t at = first(frame);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = squares_[at + i] * (share * evenness_[at + i]);
    return image;
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    statistics.steps.push_back(step_);
    statistics.bytes += bytes(frames_, crop_);
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state)) return false;
    state.sum(step_.seconds);
    if (state.merges()) return merge(state);
    state.value(done_);
    state.value(means_);
    state.value(squares_);
    state.value(half_);
    state.value(evenness_);
    expect_iterations(done_);
    for (const Rgb& c : squares_) expect_possible(!(c.r < 0 || c.g < 0 || c.b < 0), "its variance");
    for (const float e : evenness_) expect_possible(e >= 0, "its variance");
    return true;
  }

 private:
  /// Takes in another part's iterations, as if this one had done them. [Chan et al. 1979]
  bool merge(StateStream& part) {
    const int done = done_;
    const std::vector<Rgb> means = means_, squares = squares_;
    const std::vector<float> evenness = evenness_;
    part.value(done_);
    part.value(means_);
    part.value(squares_);
    part.value(half_);
    part.value(evenness_);
    const int both = done + done_;
    if (both == 0) return true;
    const float theirs = static_cast<float>(done_) / static_cast<float>(both),
                weight = static_cast<float>(done) * theirs;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Rgb apart = means_[i] - means[i];
      means_[i] = means[i] + apart * theirs;
      squares_[i] += squares[i] + apart * apart * weight;
      evenness_[i] = evenness[i] + (evenness_[i] - evenness[i]) * theirs;
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
    constexpr int kFirstDoubled = 4;
    if (done_ < kFirstDoubled || !std::has_single_bit(static_cast<unsigned>(done_))) return;
    Rgb* const half = &half_[first(frame)];
    if (done_ > kFirstDoubled) {
      std::vector<Both> both(image.pixels.size());
      for (std::size_t i = 0; i < both.size(); ++i) {
        const Rgb change = means[i] - half[i];
        both[i] = {luminance(change * change), luminance(squares[i]) / weight};
      }
      set_evenness(both, &evenness_[first(frame)]);
    }
    std::copy(means, means + image.pixels.size(), half);
  }

  /// The variance of a pixel as both estimates have it, as luminances are weighted.
  struct Both {
    float of_halves, of_iterations;
  };

  /// Sets the quotient of the two estimates over the pixels around each that are about as noisy: at an edge, or under a
  /// speck, it is another one than beside it.
  void set_evenness(const std::vector<Both>& both, float* evenness) const {
    constexpr int kAround = 4;
    constexpr float kAlike = 4;
    const int width = crop_.width(), height = crop_.height();
    const auto at = [width](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float noise = both[at(x, y)].of_iterations;
        float of_halves = 0, of_iterations = 0;
        for (int j = std::max(y - kAround, 0); j <= std::min(y + kAround, height - 1); ++j)
          for (int i = std::max(x - kAround, 0); i <= std::min(x + kAround, width - 1); ++i) {
            const Both& near = both[at(i, j)];
            if (near.of_iterations > kAlike * noise || noise > kAlike * near.of_iterations) continue;
            of_halves += near.of_halves, of_iterations += near.of_iterations;
          }
        evenness[at(x, y)] = of_iterations > 0 ? of_halves / of_iterations : 1;
      }
  }

  PixelRect crop_;
  int frames_, done_ = 0;
  std::vector<Rgb> means_, squares_;  // by frame and pixel
  std::vector<Rgb> half_;             // the means when the number of iterations last was a power of two
  std::vector<float> evenness_;       // the variance over that of independent iterations
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
