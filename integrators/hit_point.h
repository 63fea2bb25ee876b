// Hit points: where camera paths end and gather photons, for all frames at once, split where frames part. [WG12 4.1]
#pragma once

#include <vector>

#include "integrators/integrator.h"

namespace dspm {

struct HitPoint {
  Vec3 p, p_error;
  Vec3 ng;         // on wo's side
  Vec3 wo;         // back along the camera path
  Rgb throughput;  // of the path, over the chance that it ended here
  FrameSet frames;
  float radius;     // to start with: the scene's, or from the pixel's footprint
  int pixel;        // within the crop, row by row
  LobeSet lobes;    // that gather here
  bool lambertian;  // f is constant: throughput holds it, and bsdf is not to be asked (unless it is to be kept)
  bool transmits;   // photons on the other side of the surface count as well
  BsdfSlot bsdf;
};

/// Light that a camera path saw itself: emission, or sampled direct light; radiance times throughput.
struct SeenLight {
  int pixel;
  FrameSet frames;
  Rgb radiance;
};

struct HitPointSettings {
  int max_depth = 8;
  float least_alpha = 0.25f;   // lobes at least this rough gather, smoother ones are followed
  float radius = 0;            // 0: from the pixel's footprint
  bool sample_direct = false;  // direct light at the hit point by a shadow ray
  bool keep_bsdf = false;      // no hit point is `lambertian`
};

/// The hit points of one tile of pixels.
struct HitPointTile {
  std::vector<HitPoint> hit_points;  // at most one for a pixel and frame
  std::vector<SeenLight> seen;
  PathCounts paths;
  std::uint64_t invalid = 0;  // non-finite contributions that were kept out
};

/// The mean over all hit points of the root of what `radius2_of` says: what the photon map's cells should be like.
template <class Radius2Of>
float mean_search_radius(const std::vector<HitPointTile>& tiles, Radius2Of&& radius2_of, float fallback) {
  double radii = 0;
  std::size_t count = 0;
  for (const HitPointTile& tile : tiles) {
    count += tile.hit_points.size();
    for (const HitPoint& hit : tile.hit_points) radii += std::sqrt(static_cast<double>(radius2_of(hit)));
  }
  return count == 0 ? fallback : static_cast<float>(radii / static_cast<double>(count));
}

/// Takes the tiles' counts into `statistics`.
void account(const std::vector<HitPointTile>& tiles, Statistics& statistics);
std::size_t bytes_of(const std::vector<HitPointTile>& tiles);

/// Traces one camera path for each pixel of the crop, in parallel over tiles; buffers in `reuse` are taken over.
std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render,
                                           const HitPointSettings& settings, std::uint64_t iteration,
                                           std::vector<HitPointTile> reuse);

}  // namespace dspm
