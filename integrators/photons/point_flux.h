// The flux that a device has gathered at hit points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/untouched.h"

namespace dspm {

/// That of one hit point, times f; see GatheredFlux.
struct PointFlux {
  Spectrum shared;
  std::uint32_t first_own;  // of the frames with_own, in their order
  FrameSet with_own;
  std::uint32_t found, found_separate, tests;  // photons, see GatherCounts
};

struct FluxOfPoints {
  UntouchedVector<PointFlux> points;
  UntouchedVector<Spectrum> own;
  /// Photons whose flux was not finite or negative, at a hit point.
  struct Rejection {
    std::uint32_t point, number;  // the number tells those of a point apart
    int material;
    FrameSet frames;

    constexpr std::uint64_t order() const { return static_cast<std::uint64_t>(point) << 32 | number; }
  };
  UntouchedVector<Rejection> rejections;   // in their order()
  std::vector<std::uint32_t> first_point;  // by tile, and one past the last

  /// The flux of one hit point, with the functions of GatheredFlux.
  class Of {
   public:
    Of(const PointFlux& point, const Spectrum* own) : point_(point), own_(own) {}
    const Spectrum& shared() const { return point_.shared; }
    FrameSet with_own() const { return point_.with_own; }
    const Spectrum& own(Frame frame) const { return own_[(point_.with_own & FrameSet::first(frame)).count()]; }

   private:
    const PointFlux& point_;
    const Spectrum* own_;
  };
  Of of(std::size_t point) const { return {points[point], own.data() + points[point].first_own}; }
};

}  // namespace dspm
