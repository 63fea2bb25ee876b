// The weights by which vertex connection and merging combines the ways to find one and the same path, by the balance
// heuristic. Each subpath carries two sums over other ways to find it, relative to its own density; a way's weight
// needs only the sums of its two ends. [Georgiev 2012, Implementing Vertex Connection and Merging; (n) is an equation
// there]
//
// Beside connections, vertices are merged only where light arrives from a mirror or a narrow lobe, since there a
// connection fails: either its end is specular, or it meets the lobe by chance. Elsewhere all merges of a camera path
// share its own variance, so they do less than their number says and would take weight from better ways. [Jendersie and
// Grosch 2018, Variance Reduction via Footprint Estimation in the Presence of Path Reuse] The rule asks only for the
// density of one scattering of light, which both subpaths know, so it is a property of the path, as weights that sum to
// 1 demand.
//
// The sums hold for every frame of the subpath: frames stay together only as long as all densities are the same.
// Russian roulette is left out of all densities. Of the report's three sums, d_VM is d_VC / eta: hits of lights, shadow
// rays and connections to the camera never depend on whether paths are merged.
#pragma once

namespace dspm {

/// The ways that there are besides camera paths that hit lights and shadow rays to lights.
struct VcmWays {
  float merging = 0;           // eta = N pi r^2, for N light subpaths; 0: vertices are not merged
  float sighting = 0;          // N if vertices of light subpaths are connected to the camera, else 0
  bool connecting = false;     // vertices of camera subpaths are connected to those of light subpaths
  float merging_in_media = 0;  // N 4/3 pi r^3, with a radius of its own

  VcmWays with_merging(float eta) const { return {eta, sighting, connecting, merging_in_media}; }
};

/// Returns what merges count where light arrives that was scattered with this density, by solid angle; 0 if it was
/// emitted.
inline float merging_after(const VcmWays& ways, float light_pdf_w) {
  constexpr float kNarrow = 1;  // per steradian: a reflecting lobe of roughness 0.28; 1 / pi at most if matte
  return !ways.connecting || light_pdf_w >= kNarrow ? ways.merging : 0;
}

struct SubpathWeights {
  float vcm = 0;  // d_VCM: the way that connects the ends of the last segment
  float vc = 0;   // d_VC, over the solid angle of the last segment's reverse: all shorter subpaths
  float vm = 0;   // likewise, of a camera subpath: merges at the vertex before, if light leaves this one narrowly

  /// Starts at a light's point or direction, of density `emission` together with the segment, and `next_event` if a
  /// shadow ray samples it. `cosine` is that at the light; 0 for a delta light, which no ray can hit, and 1 at
  /// infinity.
  static SubpathWeights leaving_light(float next_event, float emission, float cosine) {
    return {next_event / emission, cosine / emission};
  }
  /// Starts at the camera's first vertex, whose density by area is `pdf_a`.
  static SubpathWeights at_first_vertex(const VcmWays& ways, float pdf_a) { return {ways.sighting / pdf_a, 0}; }

  /// Arrives at a surface; the segment's squared length counts as 1 if it comes from infinity. (31), (32), (34), (35) A
  /// walk through a body has the same density both ways except for the cosines at its ends, as a straight segment has,
  /// and no connection replaces it.
  SubpathWeights arrived(float distance2, float cosine, bool walked = false) const {
    return {walked ? 0 : vcm * distance2 / cosine, vc / cosine, vm / cosine};
  }
  /// Scatters a light subpath with these densities, by solid angle, of the new segment and of the reverse of the last
  /// one. `merging` is what merges count here.
  SubpathWeights light_scattered(const VcmWays& ways, float pdf_w, float reverse_pdf_w, float cosine,
                                 float merging) const {
    return scattered(ways, pdf_w, reverse_pdf_w, cosine, merging, 0);
  }
  SubpathWeights camera_scattered(const VcmWays& ways, float pdf_w, float reverse_pdf_w, float cosine) const {
    return scattered(ways, pdf_w, reverse_pdf_w, cosine, 0, ways.merging);
  }
  /// Scatters at a mirror: both directions determine each other.
  SubpathWeights mirrored(float cosine) const { return {0, (vc + vm) * cosine, 0}; }

  /// Sums all ways with a shorter subpath, given the density of the last segment's reverse.
  float shorter(const VcmWays& ways, float reverse_pdf_w) const {
    return vcm + reverse_pdf_w * before(ways, reverse_pdf_w);
  }
  /// Sums the ways without the last segment, over that density.
  float before(const VcmWays& ways, float reverse_pdf_w) const {
    return vc + (merging_after(ways, reverse_pdf_w) > 0 ? vm : 0);
  }

 private:
  SubpathWeights scattered(const VcmWays& ways, float pdf_w, float reverse_pdf_w, float cosine, float merging,
                           float perhaps_merging) const {
    return {ways.connecting ? 1 / pdf_w : 0, cosine / pdf_w * (merging + shorter(ways, reverse_pdf_w)),
            cosine / pdf_w * perhaps_merging};
  }
};

/// A subpath's last vertex, as paths from the other subpath's end come to it.
struct SubpathEnd {
  SubpathWeights weights;
  float reverse_pdf_w;  // of going on along the reverse of the last segment, by solid angle
  float pdf_a = 0;      // of arriving here, by area, over the density of the way in question
  float merging = 0;    // what merges here count

  /// Sums all ways with a shorter subpath on this side, and merges at its end.
  float others(const VcmWays& ways) const { return pdf_a * (merging + weights.shorter(ways, reverse_pdf_w)); }
};

/// The weight if the camera subpath hits a light. `next_event` is the density of a shadow ray to that point, over that
/// of the hit; `emission` is that of a light subpath's start there. (37), (43)
inline float weight_of_hit(const VcmWays& ways, float next_event, float emission, const SubpathWeights& camera) {
  return 1 / (1 + next_event + emission * camera.before(ways, 0));
}
/// The weight of a shadow ray to a light. `hit` is the density of hitting it, over that of the shadow ray. (37), (44),
/// (45)
inline float weight_of_next_event(const VcmWays& ways, float hit, const SubpathEnd& camera) {
  return 1 / (1 + hit + camera.others(ways));
}
/// The weight of a connection. (37), (40), (41)
inline float weight_of_connection(const VcmWays& ways, const SubpathEnd& light, const SubpathEnd& camera) {
  return 1 / (1 + light.others(ways) + camera.others(ways));
}
/// The weight of a light subpath's end that the camera sees. (37), (46)
inline float weight_of_sighting(const VcmWays& ways, const SubpathEnd& light) { return 1 / (1 + light.others(ways)); }
/// The weight of a merge: both ends are one vertex. (37) to (39)
inline float weight_of_merging(const VcmWays& ways, const SubpathEnd& light, const SubpathEnd& camera) {
  const float shorter =
      light.weights.shorter(ways, light.reverse_pdf_w) + camera.weights.shorter(ways, camera.reverse_pdf_w);
  return 1 / (1 + shorter / ways.merging);
}

}  // namespace dspm
