// Light subpaths: traced once for all frames, split where frames part. Their vertices are stored for connections and
// merging, and connected to the camera.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/splats.h"
#include "dspm/integrators/methods/vcm/subpath_weights.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/photons/curve_photons.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/shape_face.h"
#include "dspm/integrators/transport/strand.h"

namespace dspm {

/// A vertex on a surface that scatters by lobes other than specular ones, too, or in a medium.
struct LightVertex {
  Vec3 p, wi;      // towards where the flux came from
  ShapeFace face;  // the one that it has reached
  Spectrum flux;   // in W; includes |cos(wi, ns) / cos(wi, ng)|, as Photon::flux does
  int light;       // the light that it comes from: an index of the scene
  FrameSet frames;
  StrandList strands;  // in its trace's table
  int bounces;         // scatterings before
  SubpathWeights weights;
  float merging;  // what merges count here; 0: there are none
  RayHit hit;     // of the surface
  // See SurfacePoint.
  float outside_eta, outside_dispersion;
  Wavelength wavelength;
  int medium = kNoMedium;  // kNoMedium: it is on a surface

  /// Returns the factor to the light that `bsdf`, its own, sends along `wo`.
  Spectrum hue_by(const Bsdf& bsdf, const Vec3& wo, bool camera_is_alone) const {
    if (wavelength.nm == 0) return Spectrum(1);
    const bool alone = wavelength.alone || bsdf.disperses(wo, wi);
    return hue_of_found(alone ? wavelength.nm : 0, camera_is_alone);
  }
  /// Returns the factor to the light that arrives here, where the camera's path meets it.
  Spectrum hue_on_merging(bool camera_is_alone) const { return hue_of_found(wavelength.only_nm(), camera_is_alone); }
};

/// The results of a range of light subpaths.
struct LightTrace {
  std::vector<LightVertex> vertices;   // by path index, then branch
  std::vector<std::size_t> ends;       // of each path's vertices
  std::vector<CurvePhoton> on_curves;  // as in PhotonTrace
  std::vector<Splat> splats;
  StrandTable strands;
  PathCounts paths;
  SharedCount stored;
  Rejections rejections;
};

class LightSubpaths {
 public:
  /// Traces all light subpaths of an iteration in parallel.
  void trace(const VcmPass& pass);
  const std::vector<LightTrace>& traces() const { return traces_; }
  /// Returns the vertices of path `index`; `strands` becomes the table of their strands.
  std::span<const LightVertex> of(std::uint64_t index, const StrandTable*& strands) const;
  void account(Statistics& statistics) const;
  std::size_t bytes() const;

 private:
  std::vector<LightTrace> traces_;
};

}  // namespace dspm
