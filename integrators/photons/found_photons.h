// The outputs "photons" and "radius" of progressive integrators: what the gathers at each pixel find, in each frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/pixel_frames.h"

namespace dspm {

inline const OutputInfo kPhotonsOutput{
    "photons", {"photons.X"}, "photons found at the pixel's hit points so far", true};
inline const OutputInfo kRadiusOutput{
    "radius", {"radius.X"}, "search radius in world units, for the pixel's last hit point", true};

/// Counts in gathers of its own, so that those of the estimators stay as fast as they are.
class FoundPhotons {
 public:
  /// Keeps nothing unless one of the outputs is among `asked`.
  FoundPhotons(int pixels, int frames, const std::vector<std::string>& asked)
      : counts_(std::find(asked.begin(), asked.end(), kPhotonsOutput.name) != asked.end()),
        pixels_(bytes(pixels, frames, asked) > 0 ? pixels : 0, frames) {}
  static std::size_t bytes(int pixels, int frames, const std::vector<std::string>& asked) {
    const auto is_ours = [](const std::string& name) {
      return name == kPhotonsOutput.name || name == kRadiusOutput.name;
    };
    if (std::none_of(asked.begin(), asked.end(), is_ours)) return 0;
    return PixelFrames<Pixel>::bytes(pixels, frames);
  }
  bool are_wanted() const { return !pixels_.empty(); }

  /// Call this before the estimator gathers for the same hit point. `radius2(Frame)` returns the square of its radius
  /// in that frame; `widest2` is the largest of them. Calls for different pixels may run concurrently.
  template <class Radius2>
  void gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float widest2,
                 Radius2&& radius2) {
    std::array<float, kMaxFrames> within2;
    hit.frames.for_each([&](Frame f) {
      within2[static_cast<std::size_t>(f)] = radius2(f);
      pixels_.at(hit.pixel, f).initial_radius = hit.radius;
    });
    if (!counts_) return;
    GatherCounts not_counted;
    gather(hit, tile.scattering_of(hit), map, widest2, not_counted,
           [&](const Strand*, FrameSet frames, RgbLanes, float distance2) {
             frames.for_each([&](Frame f) {
               pixels_.at(hit.pixel, f).photons += distance2 <= within2[static_cast<std::size_t>(f)];
             });
           });
  }

  float photons(int pixel, Frame frame) const { return static_cast<float>(pixels_.at(pixel, frame).photons); }
  /// The radius before any shrinking.
  float initial_radius(int pixel, Frame frame) const { return pixels_.at(pixel, frame).initial_radius; }
  void persist(StateStream& state) { state.sum(pixels_.values()); }

 private:
  struct Pixel {
    std::uint32_t photons = 0;
    float initial_radius = 0;

    Pixel& operator+=(const Pixel& o) {
      photons += o.photons;
      if (o.initial_radius > 0) initial_radius = o.initial_radius;
      return *this;
    }
  };

  bool counts_;  // photons; else only the radius is kept
  PixelFrames<Pixel> pixels_;
};

}  // namespace dspm
