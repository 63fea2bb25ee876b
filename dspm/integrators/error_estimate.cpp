#include "dspm/integrators/error_estimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/integrators/wrapping_integrator.h"
#include "dspm/math/frames.h"

namespace dspm {
namespace {

// The median of so many pixels is within four percent of that of all. An octave: until the iterations have doubled.
constexpr int kMostPixels = 1 << 12, kSlots = 8, kFirstMark = 4, kFirstEstimate = 8;
constexpr float kConstant = 1e-5f;  // relative changes below it are rounding

/// The pixels of a grid over the crop.
class PixelGrid {
 public:
  explicit PixelGrid(const PixelRect& crop) : width_(crop.width()), height_(crop.height()) {
    while (count() > kMostPixels) ++stride_;
  }
  int count() const { return across(width_) * across(height_); }
  std::vector<float> luminances(const Image& image) const {
    std::vector<float> values(static_cast<std::size_t>(count()));
    if (image.width != width_ || image.height != height_) return values;  // it is refused when it is to be written
    auto value = values.begin();
    for (int y = 0; y < height_; y += stride_)
      for (int x = 0; x < width_; x += stride_) *value++ = luminance(image.at(x, y));
    return values;
  }

 private:
  int across(int length) const { return (length + stride_ - 1) / stride_; }

  int width_, height_, stride_ = 1;
};

/// Where the image after so many iterations is kept until there are twice as many, if it is.
std::optional<std::size_t> slot_of(int iterations, int marks_per_octave) {
  if (iterations < kFirstMark) return std::nullopt;
  const auto octave = static_cast<int>(std::bit_floor(static_cast<unsigned>(iterations)));
  const int step = std::max(octave / marks_per_octave, 1);
  if (iterations % step != 0) return std::nullopt;
  return static_cast<std::size_t>((iterations - octave) * kSlots / octave);
}

double median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

double error_of(std::span<const float> half, std::span<const float> all) {
  std::vector<float> relative;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float change = std::abs(all[i] - half[i]);
    if (std::isfinite(change) && change > kConstant * std::abs(all[i])) relative.push_back(change / std::abs(all[i]));
  }
  return median(relative);
}

class ErrorEstimate final : public WrappingIntegrator {
 public:
  ErrorEstimate(std::unique_ptr<Integrator> inner, int frames, const PixelRect& crop, int marks_per_octave)
      : WrappingIntegrator(std::move(inner)),
        marks_per_octave_(marks_per_octave),
        grid_(crop),
        frames_(static_cast<std::size_t>(frames)),
        kept_(bytes(frames, crop) / sizeof(float)),
        squares_(frames_) {}
  static std::size_t bytes(int frames, const PixelRect& crop) {
    return sizeof(float) * kSlots * static_cast<std::size_t>(frames) *
           static_cast<std::size_t>(PixelGrid(crop).count());
  }

  void iterate(int iteration, const Scene& scene) override {
    inner_->iterate(iteration, scene);
    const int done = inner_->statistics().iterations;
    if (const std::optional<std::size_t> slot = slot_of(done, marks_per_octave_)) compare(*slot, done);
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    if (estimated_ > 0)
      for (const double square : squares_) statistics.errors.push_back(std::sqrt(square) / estimated_);
    statistics.bytes += kept_.size() * sizeof(float);
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state)) return false;
    state.sum(squares_);
    state.sum(estimated_);
    state.value(kept_);
    state.value(kept_after_);
    for (const double square : squares_) expect_possible(square >= 0, "its estimate of the error");
    if (state.merges()) kept_after_.fill(0);  // half of a part is not half of the whole
    return true;
  }

 private:
  /// With the image after half of the iterations, which the present one replaces.
  void compare(std::size_t slot, int done) {
    const bool has_half = done >= kFirstEstimate && 2 * kept_after_[slot] == done;
    const std::size_t size = kept_.size() / (kSlots * frames_);
    for (std::size_t f = 0; f < frames_; ++f) {
      const std::span<float> kept(&kept_[(slot * frames_ + f) * size], size);
      const std::vector<float> now = grid_.luminances(inner_->estimate(static_cast<Frame>(f), kRadiance));
      if (has_half) squares_[f] = std::pow(done * error_of(kept, now), 2);
      std::copy(now.begin(), now.end(), kept.begin());
    }
    kept_after_[slot] = done;
    if (has_half) estimated_ = done;
  }

  int marks_per_octave_;
  PixelGrid grid_;
  std::size_t frames_;
  std::vector<float> kept_;               // luminances by slot, frame and pixel
  std::array<int, kSlots> kept_after_{};  // so many iterations
  // By frame, of the sum of so many iterations: what parts found independently of one another adds up.
  std::vector<double> squares_;
  int estimated_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> with_error_estimate(const MakeWithin& make, const Scene& scene, const PixelRect& crop,
                                                int marks_per_octave, std::size_t memory) {
  // A bound on memory has room for a copy: iterations that are cancelled are reverted to one.
  std::unique_ptr<Integrator> inner = make_beside(2 * ErrorEstimate::bytes(scene.frame_count(), crop), make, memory);
  if (inner == nullptr) return nullptr;
  return std::make_unique<ErrorEstimate>(std::move(inner), scene.frame_count(), crop, marks_per_octave);
}

}  // namespace dspm
