// The hit points of one tile of pixels, with what few of them need, and the light that camera paths saw on their way.
#pragma once

#include <cmath>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/camera_beam.h"
#include "dspm/integrators/photons/hit_point.h"
#include "dspm/integrators/seen_light.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/integrators/transport/strip_place.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

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
  RayHit hit = {};     // the camera path's, if it has ended here

  /// Returns what a photon from wi gives, per flux. Its flux counts by the normal that its shape has there. The relief
  /// is that of the hit point: it bends f as well, and within the radius normals may differ as much as they like.
  Spectrum scattered(const Vec3& wi) const {
    const Spectrum f = bsdf->evaluate(wo, wi, Transport::radiance, lobes);
    if (ns == unbent_ns) return f;
    const float unbent = dot(wi, unbent_ns);
    return unbent == 0 ? Spectrum() : f * std::abs(dot(wi, ns) / unbent);
  }
};

/// The strip that a surface that turns to rays shows to the camera path.
struct HitStrip {
  StripPlace place;
  Vec3 ns;
};

/// The hit points of one tile of pixels.
struct HitPointTile {
  std::vector<HitPoint> hit_points;  // unless paths go on from them, at most one per pixel and frame
  std::vector<HitPoint> glossy;      // where a glossy lobe extended the path: they gather only hidden photons
  std::vector<Scattering> scatterings;
  std::vector<HitStrip> strips;
  std::vector<CameraBeam> beams;  // in media
  std::vector<MediumStep> steps;  // of the beams
  StrandTable strands;
  std::vector<SeenLight> seen;
  const Palette* palette = &Palette::rgb();  // of the iteration
  double radii_in_pixels = 0;                // the sum over hit points of initial radius over pixel spacing
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
  MediumSection section_of(const CameraBeam& beam) const {
    return {beam.begin, beam.end, beam.left, beam.sigma_t, std::span(steps).subspan(beam.first_step, beam.steps), {}};
  }
  /// Removes all that it holds but keeps the memory, for an iteration of that palette.
  void start(const Palette& of_iteration);
};

/// Adds the tiles' counts to `statistics`.
void account(const std::vector<HitPointTile>& tiles, Statistics& statistics);
std::size_t bytes_of(const std::vector<HitPointTile>& tiles);

}  // namespace dspm
