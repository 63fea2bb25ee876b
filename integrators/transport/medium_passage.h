// The passage of light along a ray through one state of a medium, without a collision: what is left of it at each point. In a
// medium that varies this is an estimate by ratio tracking, without bias at each point. [Novák et al. 2014, Residual Ratio
// Tracking]
#pragma once

#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/media/majorants.h"
#include "dspm/media/medium.h"

namespace dspm {

/// The numbers of a path's bounce, for segments between two points.
struct SegmentNumbers {
  const PathRandom& random;
  int bounce;
  int used = 0;  // of them

  float next();
};

/// From `t` on, `left` of the light is left, up to the next step.
struct MediumStep {
  float t;
  Spectrum left;
};

/// One of the collisions that a medium that varies may have along a section, drawn in proportion to the light that it scatters to
/// the ray's origin.
class DrawnCollision {
 public:
  DrawnCollision() = default;
  explicit DrawnCollision(float u) : u_(u) {}

  void offer(float t, const Spectrum& scattered, float g);
  bool has_any() const { return sum_ > 0; }
  float t() const { return t_; }
  /// What it scatters, over the chance that it was drawn: the mean is that of all collisions together.
  Spectrum scattered() const { return scattered_ * (sum_ / max_component(scattered_)); }
  float g() const { return g_; }

 private:
  float u_ = 0, sum_ = 0, t_ = 0, g_ = 0;
  Spectrum scattered_;
};

/// A part of a ray in a medium.
struct MediumSection {
  float begin, end;                   // along the ray
  Spectrum left;                      // of light at `begin`
  Spectrum sigma_t;                   // if the medium is the same everywhere; else black
  std::span<const MediumStep> steps;  // if it varies
  Spectrum glow;                      // radiance that the medium adds, as it is left at the ray's origin
  const Medium* medium = nullptr;
  DrawnCollision drawn = {};  // if the medium varies, and advance() was asked for it

  /// Returns what is left at a distance within the section.
  Spectrum left_at(float t) const;
};

class MediumPassage {
 public:
  /// `steps` keeps the steps of all sections, until it is cleared.
  MediumPassage(const Medium& medium, const Majorants& majorants, const Palette& palette, const Ray& ray,
                SegmentNumbers& numbers, std::vector<MediumStep>& steps);

  /// Goes on to `end`. The section's steps hold until the next call. Draws a collision, if `drawn` is not null.
  MediumSection advance(float end, DrawnCollision* drawn = nullptr);
  const Spectrum& left() const { return left_; }

 private:
  Spectrum pass_evenly(const CarriedMedium& medium, float length);
  Spectrum pass_by_steps(float end, DrawnCollision* drawn);

  const Medium& medium_;
  const Palette& palette_;
  std::optional<CarriedMedium> everywhere_;
  const Ray& ray_;
  SegmentNumbers& numbers_;
  std::vector<MediumStep>& steps_;
  TentativeCollisions collisions_;
  float t_ = 0;
  Spectrum left_{1};
};

}  // namespace dspm
