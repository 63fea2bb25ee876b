// Where paths may collide with a medium, for all of its states in the file at once: so the states' paths have their tentative
// collisions at the same points, and part only where they decide differently whether a collision has an effect.
// [Woodcock et al. 1965; Kutz et al. 2017, Spectral and Decomposition Tracking]
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/media/medium.h"

namespace dspm {

/// Bounds of sigma_t by colour on a coarse grid in the world.
class Majorants {
 public:
  explicit Majorants(std::span<const Medium* const> states);

  bool is_everywhere() const { return everywhere_; }
  const Bounds3& extent() const { return extent_; }

  /// Returns what sigma_t may be, at the palette's wavelengths, over the bound that is made of colours: more than 1 if
  /// states are given as spectra.
  Spectrum most_over_bound(const Palette& palette) const;

 private:
  friend class TentativeCollisions;

  const Rgb& of(const std::array<int, 3>& cell) const {
    return cells_[static_cast<std::size_t>((cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0])];
  }

  bool everywhere_ = false;
  Bounds3 extent_;
  std::array<int, 3> counts_{1, 1, 1};
  std::vector<Rgb> cells_;              // x fastest
  std::vector<MediumSpectra> spectra_;  // of the states that have them
};

/// Draws the tentative collisions along a ray, one after another, by the majorant of one colour.
class TentativeCollisions {
 public:
  static constexpr int kLargest = 3;  // stands for the colour of the largest majorant at each point

  TentativeCollisions(const Majorants& majorants, const Ray& ray, int colour, const Palette& palette);

  /// Goes on to the next collision or, if there is none before it, to `end`. Returns whether it has met one. `number()`
  /// returns a uniform number in [0, 1) that no other call returns.
  template <class Number>
  bool advance(float end, Number&& number);

  float distance() const { return t_; }
  /// The majorant at the collision.
  const Spectrum& majorant() const { return majorant_; }
  /// The integral of the majorants over the part of the ray that the last call has passed.
  const Spectrum& depth() const { return depth_; }

 private:
  float rate() const { return colour_ == kLargest ? max_component(majorant_) : majorant_[colour_]; }
  void enter();
  void enter_next_cell();
  void pass(float to);

  const Majorants& majorants_;
  const Ray ray_;
  int colour_;
  float t_ = 0, t_in_ = 0, t_out_ = kInfinity;  // the ray is in the grid between the last two
  float t_cell_ = -1;                           // where the cell ends; below 0: the grid has not been entered
  float left_ = -1;                             // depth up to the next collision; below 0: not drawn
  std::array<int, 3> cell_{};
  Vec3 t_next_;  // where the ray crosses the next plane of each axis
  const Palette& palette_;
  const Spectrum over_bound_;
  Spectrum majorant_, depth_;
};

template <class Number>
bool TentativeCollisions::advance(float end, Number&& number) {
  depth_ = {};
  while (t_ < end) {
    if (t_cell_ < 0) {
      if (!(t_in_ < t_out_) || end <= t_in_) break;
      enter();
    }
    if (t_ >= t_out_) break;
    if (left_ < 0) left_ = -rounded::log(1 - number());
    const float stop = std::min(t_cell_, end), dense = rate(), ahead = dense > 0 ? dense * (stop - t_) : 0;
    if (left_ < ahead) {
      pass(std::min(t_ + left_ / dense, stop));
      left_ = -1;
      return true;
    }
    left_ -= ahead;
    pass(stop);
    if (stop == t_cell_ && stop < end) enter_next_cell();
  }
  t_ = std::max(t_, end);
  return false;
}

}  // namespace dspm
