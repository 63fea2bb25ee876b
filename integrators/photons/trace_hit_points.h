// Traces camera paths to their hit points, for all frames at once; paths split where frames part. [WG12 4.1]
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/moment_pixels.h"
#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class DirectBalance;

inline constexpr float kNothingGathers = kInfinity;  // a least alpha: all lobes are followed, diffuse ones as well

struct HitPointSettings {
  int max_depth = 8;
  float least_alpha = 0.25f;     // lobes at least this rough gather, smoother ones extend the path; kNothingGathers
  float radius = 0;              // 0: from the pixel's footprint
  bool sample_direct = false;    // direct light at the hit point by a shadow ray
  bool light_media = false;      // direct light that media scatter by shadow rays, too
  bool photons_as_well = false;  // with sample_direct: photons bring direct light, too, and the ways are weighted
  const DirectBalance* direct = nullptr;  // with sample_direct: the weights of all ways to find direct light
  bool keep_bsdf = false;                 // every hit point has its `scattering`
  bool share_paths = false;               // frames that differ only in appearance or light share paths; else they part
  /// Camera paths go on from hit points to others and find what rough surfaces scatter; photons need not.
  bool go_on = false;
  FrameSet frames = FrameSet::first(kMaxFrames);  // in which camera paths are traced
  MomentPixels pixels = {};                       // from which they are traced
};

std::size_t hit_point_tile_count(const PixelRect& crop);

/// Traces one camera path per pixel of the crop, in parallel over tiles; with a `stride`, only every stride-th pixel of
/// every stride-th row. Recycles the buffers in `reuse`.
std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render,
                                           const HitPointSettings& settings, std::uint64_t iteration,
                                           std::vector<HitPointTile> reuse, int stride = 1);

/// Returns the pixels of a tile, as x and y in the full image, from which trace_hit_points() sends camera paths.
std::vector<std::array<int, 2>> pixels_of_hit_point_tile(const RenderSettings& render, const HitPointSettings& settings,
                                                         std::size_t tile, int stride = 1);

/// Returns whether hidden photons may exist, for which glossy lobes look that extend paths.
bool may_hide_photons(const Scene& scene, const HitPointSettings& settings);

}  // namespace dspm
