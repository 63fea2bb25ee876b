// The vertices of all light subpaths, by place and frame: those that several frames share in one grid, those of a
// single frame in a grid of that frame.
#pragma once

#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/light_subpaths.h"
#include "dspm/integrators/photons/curve_photons.h"
#include "dspm/integrators/photons/photon_grid.h"

namespace dspm {

class LightVertexMap {
 public:
  struct Radii {
    float on_surfaces, in_media;
  };

  /// Builds the map for a scene with that many frames. The traces must outlive the map.
  void build(const std::vector<LightTrace>& traces, int frames, const Radii& radii);
  std::size_t bytes() const;
  /// The light subpaths that ended on surfaces that turn, with light that only merging finds.
  const CurvePhotons& on_curves() const { return on_curves_; }

  /// Calls fn(const LightVertex&, const Strand*) for all vertices in media within sqrt(radius2) of p; returns how many it
  /// tested.
  template <class Fn>
  std::uint64_t for_each_in_media_within(const Vec3& p, float radius2, Fn&& fn) const {
    return in_media_.for_each_within(
        p, radius2, [&](const Placed& found, float, const auto&) { fn(*found.vertex, found.strands); });
  }

  /// Calls fn(const LightVertex&, const Strand*) for all vertices on surfaces within sqrt(radius2) of p that exist in some
  /// of `frames`, and perhaps for others; returns how many it tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, FrameSet frames, Fn&& fn) const {
    const auto pass_on = [&](const Placed& found, float, const auto&) { fn(*found.vertex, found.strands); };
    std::uint64_t tested = common_.for_each_within(p, radius2, pass_on);
    if (!of_frame_.empty())
      frames.for_each([&](Frame frame) {
        tested += of_frame_[static_cast<std::size_t>(frame)].for_each_within(p, radius2, pass_on);
      });
    return tested;
  }

 private:
  struct Placed {
    const LightVertex* vertex;
    const Strand* strands;
  };
  static void build(PhotonGrid<Placed>& grid, const std::vector<Placed>& vertices, float radius);

  CurvePhotons on_curves_;
  PhotonGrid<Placed> in_media_;
  PhotonGrid<Placed> common_;
  std::vector<PhotonGrid<Placed>> of_frame_;
  std::vector<Placed> to_media_;             // for the grid
  std::vector<std::vector<Placed>> sorted_;  // for the grids: shared vertices, then those of each frame
};

}  // namespace dspm
