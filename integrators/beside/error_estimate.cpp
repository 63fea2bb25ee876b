#include "dspm/integrators/beside/error_estimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/median.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/integrators/beside/wrapping_integrator.h"
#include "dspm/integrators/possible_state.h"

namespace dspm {
namespace {

// The median of so many pixels is within four percent of the median of all. An octave lasts until the iterations have
// doubled.
constexpr int kMostPixels = 1 << 12, kSlots = 8, kFirstMark = 4, kFirstEstimate = 8;
constexpr float kConstant = 1e-5f;  // relative changes below it are rounding
// Noise of a normal distribution hardly ever exceeds six times the median of its magnitude, which is four deviations.
constexpr int kMostParts = 1 << 10;
constexpr double kLoneChange = 0.5, kUnusual = 6;

/// The part of an image that is kept: the luminances of some of its pixels, and the brightest of each of its parts.
struct Seen {
  std::span<float> pixels, peaks;
};

/// Squares of pixels over the crop.
class Squares {
 public:
  Squares(const PixelRect& crop, int most) : width_(crop.width()), height_(crop.height()) {
    while (count() > most) ++side_;
  }
  int count() const { return across(width_) * across(height_); }
  int across(int length) const { return (length + side_ - 1) / side_; }
  bool begins_at(int x, int y) const { return x % side_ == 0 && y % side_ == 0; }
  std::size_t of(int x, int y) const { return static_cast<std::size_t>(y / side_ * across(width_) + x / side_); }

 private:
  int width_, height_, side_ = 1;
};

class Sample {
 public:
  explicit Sample(const PixelRect& crop)
      : width_(crop.width()), height_(crop.height()), pixels_(crop, kMostPixels), parts_(crop, kMostParts) {}
  std::size_t size() const { return static_cast<std::size_t>(pixels_.count() + parts_.count()); }
  Seen parted(std::span<float> values) const {
    const auto pixels = static_cast<std::size_t>(pixels_.count());
    return {values.first(pixels), values.subspan(pixels)};
  }
  int parts_across() const { return parts_.across(width_); }
  /// Returns zeros if the image has another size: it is refused when it is to be written.
  std::vector<float> of(const Image& image) const {
    std::vector<float> values(size());
    if (image.width != width_ || image.height != height_) return values;
    const Seen seen = parted(values);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float value = luminance(image.at(x, y));
        float& peak = seen.peaks[parts_.of(x, y)];
        peak = std::max(peak, value);
        if (pixels_.begins_at(x, y)) seen.pixels[pixels_.of(x, y)] = value;
      }
    return values;
  }

 private:
  int width_, height_;
  Squares pixels_, parts_;
};

/// Returns where the image after so many iterations is kept until there are twice as many; nullopt if it is not kept.
std::optional<std::size_t> slot_of(int iterations, int marks_per_octave) {
  if (iterations < kFirstMark) return std::nullopt;
  const auto octave = static_cast<int>(std::bit_floor(static_cast<unsigned>(iterations)));
  const int step = std::max(octave / marks_per_octave, 1);
  if (iterations % step != 0) return std::nullopt;
  return static_cast<std::size_t>((iterations - octave) * kSlots / octave);
}

double error_of(std::span<const float> half, std::span<const float> all) {
  std::vector<float> relative;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float change = std::abs(all[i] - half[i]);
    if (std::isfinite(change) && change > kConstant * std::abs(all[i])) relative.push_back(change / std::abs(all[i]));
  }
  return static_cast<double>(median(relative));
}

/// Returns the second brightest among a part and those around it. At the edges of what is bright, a pixel that hardly
/// covers it changes as much as under a lone path, but has such neighbours.
float around(std::span<const float> peaks, int columns, int part) {
  const int rows = static_cast<int>(peaks.size()) / columns, x = part % columns, y = part / columns;
  std::vector<float> brightest;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
      brightest.push_back(peaks[static_cast<std::size_t>(j * columns + i)]);
  const std::size_t second = std::min<std::size_t>(1, brightest.size() - 1);
  std::nth_element(brightest.begin(), brightest.begin() + static_cast<std::ptrdiff_t>(second), brightest.end(),
                   std::greater<>());
  return brightest[second];
}

/// Counts the parts that lone paths have changed. Nobody sees what changes in the dark, so every part counts as at
/// least as bright as half of the parts are.
std::uint64_t lone_paths(std::span<const float> half, std::span<const float> all, int columns, double error) {
  const double most = std::max(kLoneChange, kUnusual * error);
  std::vector<float> sorted(all.begin(), all.end());
  const float usual = median(sorted);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double change = static_cast<double>(std::abs(all[i] - half[i]));
    if (change <= most * static_cast<double>(std::max(all[i], usual))) continue;
    count += change > most * static_cast<double>(around(all, columns, static_cast<int>(i)));
  }
  return count;
}

class ErrorEstimate final : public WrappingIntegrator {
 public:
  ErrorEstimate(std::unique_ptr<Integrator> inner, int frames, const PixelRect& crop, int marks_per_octave,
                std::size_t images_at_once)
      : WrappingIntegrator(std::move(inner)),
        marks_per_octave_(marks_per_octave),
        images_at_once_(images_at_once),
        sample_(crop),
        frames_(static_cast<std::size_t>(frames)),
        kept_(bytes(frames, crop) / sizeof(float)),
        squares_(frames_) {}
  static std::size_t bytes(int frames, const PixelRect& crop) {
    return sizeof(float) * kSlots * static_cast<std::size_t>(frames) * Sample(crop).size();
  }

  void iterate(const Iteration& iteration) override {
    inner_->iterate(iteration);
    const int done = inner_->statistics().iterations;
    if (const std::optional<std::size_t> slot = slot_of(done, marks_per_octave_)) compare(*slot, done);
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    if (estimated_ > 0)
      for (const double square : squares_) statistics.errors.push_back(std::sqrt(square) / estimated_);
    if (lone_ > 0) statistics.counters.add(kLonePaths, lone_);
    statistics.steps.push_back(step_);
    statistics.bytes += kept_.size() * sizeof(float);
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state)) return false;
    state.sum(squares_);
    state.sum(estimated_);
    state.sum(step_.seconds);
    state.largest(lone_);
    state.value(kept_);
    state.value(kept_after_);
    for (const double square : squares_) expect_possible(square >= 0, "its estimate of the error");
    if (state.merges()) kept_after_.fill(0);  // half of a part is not half of the whole
    return true;
  }

 private:
  /// Compares the present image with the one after half of the iterations, which it replaces.
  void compare(std::size_t slot, int done) {
    const StepTimer timer(step_);
    const bool has_half = done >= kFirstEstimate && 2 * kept_after_[slot] == done;
    const std::size_t size = sample_.size();
    std::vector<std::uint64_t> lone(frames_);
    const auto compare_in = [&](std::size_t f) {
      const std::span<float> kept(&kept_[(slot * frames_ + f) * size], size);
      std::vector<float> now = sample_.of(inner_->estimate(static_cast<Frame>(f), kRadiance));
      if (has_half) {
        const Seen half = sample_.parted(kept), all = sample_.parted(now);
        const double error = error_of(half.pixels, all.pixels);
        squares_[f] = std::pow(done * error, 2);
        lone[f] = lone_paths(half.peaks, all.peaks, sample_.parts_across(), error);
      }
      std::copy(now.begin(), now.end(), kept.begin());
    };
    for (std::size_t first = 0; first < frames_; first += images_at_once_)
      parallel_for(static_cast<std::int64_t>(std::min(images_at_once_, frames_ - first)), 1,
                   [&](std::int64_t i) { compare_in(first + static_cast<std::size_t>(i)); });
    if (has_half) lone_ = *std::max_element(lone.begin(), lone.end());
    kept_after_[slot] = done;
    if (has_half) estimated_ = done;
  }

  int marks_per_octave_;
  std::size_t images_at_once_;
  Sample sample_;
  std::size_t frames_;
  std::vector<float> kept_;               // samples by slot and frame
  std::array<int, kSlots> kept_after_{};  // the iterations after which they were kept
  // By frame, of the sum of so many iterations: what parts found independently of one another adds up.
  std::vector<double> squares_;
  int estimated_ = 0;
  std::uint64_t lone_ = 0;  // as of the last estimate
  StepTime step_{"error estimate"};
};

}  // namespace

std::unique_ptr<Integrator> with_error_estimate(const MakeWithin& make, const Scene& scene, const PixelRect& crop,
                                                int marks_per_octave, std::size_t memory) {
  // A bound on memory has room for a copy: iterations that are cancelled are reverted to one.
  std::unique_ptr<Integrator> inner = make_beside(2 * ErrorEstimate::bytes(scene.frame_count(), crop), make, memory);
  if (inner == nullptr) return nullptr;
  // A bound on memory has room for one whole image.
  constexpr std::size_t kRoom = std::size_t{256} << 20;
  const std::size_t image_bytes = static_cast<std::size_t>(crop.count()) * sizeof(Rgb);
  const std::size_t at_once = memory > 0 ? 1 : std::max<std::size_t>(1, kRoom / std::max<std::size_t>(1, image_bytes));
  return std::make_unique<ErrorEstimate>(std::move(inner), scene.frame_count(), crop, marks_per_octave, at_once);
}

}  // namespace dspm
