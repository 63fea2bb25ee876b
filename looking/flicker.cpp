#include "dspm/looking/flicker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/encoding.h"

namespace dspm {
namespace {

constexpr std::size_t kSampledPixels = 1 << 16;
constexpr double kOfNormalMedian = 1.482602;  // the standard deviation over the median of magnitudes

std::vector<float> brightnesses(const Image& image) {
  std::vector<float> values;
  values.reserve(image.pixels.size());
  for (const Rgb& c : image.pixels) values.push_back(linear_to_srgb(0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b));
  return values;
}

}  // namespace

void FlickerMeter::add(const Image& shown) {
  std::vector<float> now = brightnesses(shown);
  if (frames_ == 0) {
    width_ = shown.width, height_ = shown.height;
    squares_.assign(now.size(), 0);
    stride_ = now.size() / kSampledPixels + 1;
  } else if (shown.width != width_ || shown.height != height_) {
    throw std::runtime_error("the frames differ in size");
  }
  if (++frames_ >= 3)
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double left =
          static_cast<double>(last_[i]) - 0.5 * (static_cast<double>(before_[i]) + static_cast<double>(now[i]));
      squares_[i] += left * left / 1.5;
      if (i % stride_ == 0) magnitudes_.push_back(static_cast<float>(std::abs(left) / std::sqrt(1.5)));
    }
  before_ = std::exchange(last_, std::move(now));
}

Flicker FlickerMeter::result() const {
  if (frames_ < 3) throw std::runtime_error("flicker needs three frames or more");
  Flicker flicker;
  double total = 0;
  for (const double square : squares_) {
    total += square;
    flicker.rms_of_pixel.push_back(static_cast<float>(std::sqrt(square / (frames_ - 2))));
  }
  flicker.rms = std::sqrt(total / (static_cast<double>(squares_.size()) * (frames_ - 2)));
  std::vector<float> magnitudes = magnitudes_;
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  flicker.typical = kOfNormalMedian * static_cast<double>(*middle);
  return flicker;
}

}  // namespace dspm
