// Hit points: where camera paths end and gather photons, for all frames at once, split where frames part. [WG12 4.1]
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/seen_light.h"
#include "dspm/integrators/transport/shape_face.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/integrators/transport/strip_place.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

struct HitPoint {
  Vec3 p;
  Vec3 ng;         // on the camera path's side
  Rgb throughput;  // of the path, divided by the probability that it ended here; times f if there is no `scattering`
  ShapeFace face;  // the one that the camera path has reached
  FrameSet frames;
  float radius;            // initial: the scene's, or from the pixel's footprint
  int pixel;               // within the crop, row by row
  bool indirect = false;   // the path has left another hit point before
  bool caught = false;     // its first surface is a shadow catcher
  int scattering = -1;     // index in the tile; negative if f is constant
  StrandList strands = 0;  // in the tile's table: factors to the throughput by frame, if they differ
};

/// Extra data of a hit point whose f is not constant. Kept separately, since most hit points do not need it.
struct Scattering {
  BsdfSlot bsdf;
  Vec3 wo;  // back along the camera path
  Vec3 p_error;
  LobeSet lobes;       // those that gather here
  bool transmits;      // light passes the surface, so photons on both sides are asked which face they have come to
  int material;        // index into the scene's
  Inside inside;       // the bodies around the hit point
  Vec3 ns, unbent_ns;  // with the relief, and without
  int strip = -1;      // index in the tile; negative if the surface does not turn to rays

  /// Returns what a photon from wi gives, per flux. Its flux counts by the normal that its shape has there. The relief
  /// is that of the hit point: it bends f as well, and within the radius normals may differ as much as they like.
  Rgb scattered(const Vec3& wi) const {
    const Rgb f = bsdf->evaluate(wo, wi, Transport::radiance, lobes);
    if (ns == unbent_ns) return f;
    const float unbent = dot(wi, unbent_ns);
    return unbent == 0 ? Rgb() : f * std::abs(dot(wi, ns) / unbent);
  }
};

/// The strip that a surface that turns to rays shows to the camera path.
struct HitStrip {
  StripPlace place;
  Vec3 ns;
};

struct HitPointSettings {
  int max_depth = 8;
  float least_alpha = 0.25f;     // lobes at least this rough gather, smoother ones extend the path
  float radius = 0;              // 0: from the pixel's footprint
  bool sample_direct = false;    // direct light at the hit point by a shadow ray
  bool photons_as_well = false;  // with sample_direct: photons bring direct light, too, and the ways are weighted
  const DirectBalance* direct = nullptr;  // with sample_direct: the weights of all ways to find direct light
  bool keep_bsdf = false;                 // every hit point has its `scattering`
  bool share_paths = false;               // frames that differ only in appearance or light share paths; else they part
  /// Camera paths go on from hit points to others and find what rough surfaces scatter; photons need not.
  bool go_on = false;
  FrameSet frames = FrameSet::first(kMaxFrames);  // in which camera paths are traced
};

/// The hit points of one tile of pixels.
struct HitPointTile {
  std::vector<HitPoint> hit_points;  // unless paths go on from them, at most one per pixel and frame
  std::vector<HitPoint> glossy;      // where a glossy lobe extended the path: they gather only hidden photons
  std::vector<Scattering> scatterings;
  std::vector<HitStrip> strips;
  StrandTable strands;
  std::vector<SeenLight> seen;
  double radii_in_pixels = 0;  // the sum over hit points of initial radius over pixel spacing
  PathCounts paths;
  Rejections rejections;

  /// Returns null if f is constant.
  const Scattering* scattering_of(const HitPoint& hit) const {
    return hit.scattering < 0 ? nullptr : &scatterings[static_cast<std::size_t>(hit.scattering)];
  }
  /// Returns null unless the hit point lies on a surface that turns to rays.
  const HitStrip* strip_of(const HitPoint& hit) const {
    const Scattering* scattering = scattering_of(hit);
    return scattering == nullptr || scattering->strip < 0 ? nullptr
                                                          : &strips[static_cast<std::size_t>(scattering->strip)];
  }
  /// Removes all hit points but keeps the memory.
  void clear();
};

std::size_t hit_point_tile_count(const PixelRect& crop);
/// Adds the tiles' counts to `statistics`.
void account(const std::vector<HitPointTile>& tiles, Statistics& statistics);
std::size_t bytes_of(const std::vector<HitPointTile>& tiles);

/// Traces one camera path per pixel of the crop, in parallel over tiles; with a `stride`, only every stride-th pixel of
/// every stride-th row. Recycles the buffers in `reuse`.
std::vector<HitPointTile> trace_hit_points(const Scene& scene, const RenderSettings& render,
                                           const HitPointSettings& settings, std::uint64_t iteration,
                                           std::vector<HitPointTile> reuse, int stride = 1);

}  // namespace dspm
