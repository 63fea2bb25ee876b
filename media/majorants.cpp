#include "dspm/media/majorants.h"

#include <algorithm>

namespace dspm {
namespace {

constexpr int kMostCells = 32;  // along the longest axis

Rgb largest(const Rgb& a, const Rgb& b) { return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)}; }

/// The part of a box that a medium can fill.
Bounds3 filled_part(const Bounds3& box, const Medium& medium) {
  const auto extent = medium.extent();
  return extent ? Bounds3{max(box.low, extent->low), min(box.high, extent->high)} : box;
}

}  // namespace

Majorants::Majorants(std::span<const Medium* const> states) {
  for (const Medium* state : states) {
    if (state->spectra().are_given()) spectra_.push_back(state->spectra());
    if (const auto extent = state->extent())
      extent_.add(*extent);
    else
      everywhere_ = true;
  }
  if (everywhere_) extent_ = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const Vec3 size = extent_.extent();
  const float longest = std::max({size.x, size.y, size.z});
  for (int axis = 0; axis < 3 && !everywhere_ && !extent_.empty(); ++axis) {
    const float cells = std::ceil(kMostCells * size[axis] / longest);
    counts_[static_cast<std::size_t>(axis)] = std::clamp(static_cast<int>(cells), 1, kMostCells);
  }
  const auto plane = [&](int axis, int i) {
    const int count = counts_[static_cast<std::size_t>(axis)];
    if (i == 0) return extent_.low[axis];
    if (i == count) return extent_.high[axis];
    return extent_.low[axis] + size[axis] * static_cast<float>(i) / static_cast<float>(count);
  };
  for (int z = 0; z < counts_[2]; ++z)
    for (int y = 0; y < counts_[1]; ++y)
      for (int x = 0; x < counts_[0]; ++x) {
        const Bounds3 box{{plane(0, x), plane(1, y), plane(2, z)}, {plane(0, x + 1), plane(1, y + 1), plane(2, z + 1)}};
        Rgb most;
        for (const Medium* state : states)
          if (const Bounds3 part = filled_part(box, *state); !part.empty()) most = largest(most, state->majorant(part));
        cells_.push_back(most);
      }
}

Spectrum Majorants::most_over_bound(const Palette& palette) const {
  Spectrum most(1);
  if (palette.is_rgb()) return most;
  for (const MediumSpectra& state : spectra_) {
    const Spectrum all = palette.per_length(state.sigma_a) + palette.per_length(state.sigma_s);
    const Spectrum bound = palette.per_length(state.sigma_a.rgb + state.sigma_s.rgb);
    for (int k = 0; k < 3; ++k)
      if (bound[k] > 0) most[k] = std::max(most[k], all[k] / bound[k]);
  }
  return most;
}

TentativeCollisions::TentativeCollisions(const Majorants& majorants, const Ray& ray, int colour, const Palette& palette)
    : majorants_(majorants),
      ray_(ray),
      colour_(colour),
      palette_(palette),
      over_bound_(majorants.most_over_bound(palette)) {
  if (majorants.everywhere_) return;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = ray.origin[axis], d = ray.direction[axis];
    const float low = majorants.extent_.low[axis], high = majorants.extent_.high[axis];
    if (d == 0) {
      if (!(o >= low && o <= high)) t_out_ = -1;
      continue;
    }
    const float near = ((d > 0 ? low : high) - o) / d, far = ((d > 0 ? high : low) - o) / d;
    t_in_ = std::max(t_in_, near), t_out_ = std::min(t_out_, far);
  }
}

void TentativeCollisions::enter() {
  t_ = std::max(t_, t_in_);
  if (majorants_.everywhere_) {
    majorant_ = palette_.per_length(majorants_.cells_.front()) * over_bound_, t_cell_ = kInfinity;
    return;
  }
  const Vec3 p = ray_.at(t_), size = majorants_.extent_.extent();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const int count = majorants_.counts_[a];
    const float low = majorants_.extent_.low[axis], width = size[axis] / static_cast<float>(count);
    cell_[a] = std::clamp(static_cast<int>((p[axis] - low) / width), 0, count - 1);
    const float d = ray_.direction[axis];
    const float plane = low + width * static_cast<float>(cell_[a] + (d > 0));
    t_next_[axis] = d == 0 ? kInfinity : (plane - ray_.origin[axis]) / d;
  }
  majorant_ = palette_.per_length(majorants_.of(cell_)) * over_bound_;
  t_cell_ = std::max(t_, std::min({t_next_.x, t_next_.y, t_next_.z, t_out_}));
}

void TentativeCollisions::enter_next_cell() {
  const int axis = t_next_.x <= t_next_.y && t_next_.x <= t_next_.z ? 0 : t_next_.y <= t_next_.z ? 1 : 2;
  const auto a = static_cast<std::size_t>(axis);
  const float d = ray_.direction[axis];
  cell_[a] += d > 0 ? 1 : -1;
  if (cell_[a] < 0 || cell_[a] >= majorants_.counts_[a]) {
    t_out_ = std::min(t_out_, t_);
    return;
  }
  const float width = majorants_.extent_.extent()[axis] / static_cast<float>(majorants_.counts_[a]);
  t_next_[axis] += width / std::abs(d);
  majorant_ = palette_.per_length(majorants_.of(cell_)) * over_bound_;
  t_cell_ = std::max(t_, std::min({t_next_.x, t_next_.y, t_next_.z, t_out_}));
}

void TentativeCollisions::pass(float to) {
  const float length = to - t_;
  if (length > 0)
    for (int c = 0; c < 3; ++c)
      if (majorant_[c] > 0) depth_[c] += majorant_[c] * length;
  t_ = to;
}

}  // namespace dspm
