// Photons as values: where flux has arrived, in which frames. trace_photons.h makes them, photon_map.h sorts them, and
// gather.h reads them. [WG12 4.2]
#pragma once

#include <cmath>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/spectrum_lanes.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/shape_face.h"
#include "dspm/integrators/transport/strand.h"

namespace dspm {

struct Photon {
  Vec3 p;
  ShapeFace face;  // the one that it has reached
  Vec3 wi;         // towards where it came from, unit length
  Spectrum flux;   // in W; includes its surface's |cos(wi, ns) / cos(wi, ng)|, so that a gather needs no cosine
  FrameSet frames;
  StrandList strands = 0;  // in its trace's table: factors to the flux by frame, if they differ
  int light = -1;          // the light that it comes from: an index of the scene
  // Its light has this wavelength alone, whose hue it still lacks (wavelength.h), in nm; 0: it has all colours.
  std::int16_t only_nm = 0;
};

/// The data of a photon that a gather needs apart from its position: half a cache line. A read of three lanes loads
/// four; the fourth, bytes of the next member, is ignored.
struct alignas(32) GatheredPhoton {
  Vec3 wi;
  Spectrum flux;  // with its signs reversed if the photon has one wavelength alone
  FrameSet frames;

  GatheredPhoton() = default;
  explicit GatheredPhoton(const Photon& photon)
      : wi(photon.wi), flux(photon.only_nm == 0 ? photon.flux : -1 * photon.flux), frames(photon.frames) {}

  __m128 wi_lanes() const { return _mm_load_ps(&wi.x); }
  bool has_one_wavelength() const { return std::signbit(flux[0]); }
  /// Of a photon of all colours.
  SpectrumLanes flux_lanes() const { return SpectrumLanes(_mm_loadu_ps(&flux.v[0])); }
  /// Of one that has one wavelength, if it has this hue.
  SpectrumLanes flux_lanes(SpectrumLanes hue) const {
    return SpectrumLanes(_mm_mul_ps(_mm_andnot_ps(_mm_set1_ps(-0.f), flux_lanes().lanes), hue.lanes));
  }
};
static_assert(sizeof(GatheredPhoton) == 32);

/// A photon whose flux differs between its frames.
struct GatheredStrands : GatheredPhoton {
  GatheredStrands() = default;
  GatheredStrands(const Photon& photon, const Strand* list) : GatheredPhoton(photon), strands(list) {}
  const Strand* strands;
};

inline const Strand* strands_of(const GatheredPhoton&) { return nullptr; }
inline const Strand* strands_of(const GatheredStrands& photon) { return photon.strands; }

}  // namespace dspm
