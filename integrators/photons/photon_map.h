// The photons of one iteration, by frame and position: a hit point need not visit those of all other frames.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photons/photon.h"
#include "dspm/integrators/photons/photon_grid.h"
#include "dspm/integrators/photons/plain_photon_map.h"

namespace dspm {

struct PhotonTrace;

/// Photons shared by several frames are in one grid. Those of a single frame are in a grid of that frame, and again in
/// a grid of all such photons, for hit points shared by many frames. If most photons are shared, all are in the first
/// grid. Photons with strands have a separate grid. The order of photons does not depend on threads.
class PhotonMap {
 public:
  PhotonMap() = default;
  /// Makes a map that tells the photons of these groups apart.
  explicit PhotonMap(LightGroups groups) : groups_(std::move(groups)) {}

  /// Sorts the photons of all `traces`, of a scene with that many frames; `cell_size` should suit a typical search
  /// radius. The traces' strands must outlive the map.
  void build(const std::vector<PhotonTrace>& traces, int frames, float cell_size);
  /// Sorts another list of theirs: hidden photons.
  void build(const std::vector<PhotonTrace>& traces, int frames, float cell_size,
             std::vector<Photon> PhotonTrace::*which);

  /// Returns whether it is the list of a light's strands, which many photons share.
  bool is_of_light(const Strand* strands) const {
    return strands >= of_lights_.data() && strands < of_lights_.data() + of_lights_.size();
  }
  const LightGroups& groups() const { return groups_; }
  /// The wavelength of the photons that have one alone; 0: all have all colours.
  std::int16_t only_nm() const { return only_nm_; }
  std::size_t size() const { return photons_.size(); }
  /// Returns the same map for a device, but for photons with strands. Both this and `of_frame`, which is filled, must outlive it.
  PlainPhotonMap plain(std::vector<PlainPhotonGrid>& of_frame) const;
  bool has_strands() const { return !strands_.empty(); }
  std::size_t bytes() const;
  /// Calls fn(const GatheredPhoton&, distance squared, details) or the same with GatheredStrands for all photons within
  /// sqrt(radius2) of p that exist in some of `frames`, and for some others; returns how many it tested. For details,
  /// see PhotonGrid: group() is only to be asked for if the map has groups.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, FrameSet frames, Fn&& fn) const {
    std::array<const PhotonGrid<GatheredPhoton>*, kFewFrames + 1> grids{&common_};
    std::size_t count = 1;
    if (frames.count() > kFewFrames)
      grids[count++] = &single_;
    else if (!of_frame_.empty())
      frames.for_each([&](Frame f) { grids[count++] = &of_frame_[static_cast<std::size_t>(f)]; });
    std::uint64_t tested = 0;
    for (std::size_t i = 0; i < count; ++i) tested += grids[i]->for_each_within(p, radius2, fn);
    return tested + with_strands_.for_each_within(p, radius2, fn);
  }

 private:
  void build_with_strands(std::size_t first, float cell_size);
  const LightGroups* told_apart() const { return groups_.count() > 0 ? &groups_ : nullptr; }

  LightGroups groups_;
  std::int16_t only_nm_ = 0;
  Buffer<const Photon*> photons_;  // shared ones, those of each frame, those with strands
  Buffer<const Strand*> strands_;  // of the latter
  std::span<const Strand> of_lights_;
  PhotonGrid<GatheredPhoton> common_, single_;
  std::vector<PhotonGrid<GatheredPhoton>> of_frame_;  // single_, frame by frame; empty if common_ has all
  PhotonGrid<GatheredStrands> with_strands_;
};

}  // namespace dspm
