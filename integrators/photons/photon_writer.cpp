#include "dspm/integrators/photons/photon_writer.h"

#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/arrival_correction.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/transport/direct_light.h"

namespace dspm {

bool PhotonWriter::is_wanted(const PhotonPath& path, const PhotonOrigin& from) const {
  // No ray looks for what media give off; of two maps, that of caustics has it.
  if (from.light.glow.medium != kNoMedium && path.kind == kDirectPhotons)
    return (settings_.kinds & kCausticPhotons) != 0;
  if (path.kind == kDirectPhotons && settings_.rays_tell && is_told_by_a_ray(scene_, from.light)) return false;
  return (path.kind & settings_.kinds) != 0;
}

void PhotonWriter::store(std::vector<Photon>& photons, const PhotonPath& path, const PhotonOrigin& from,
                         const Vertex& vertex, FrameSet frames) {
  const SurfacePoint& point = vertex.point;
  const Vec3& wi = vertex.wo;
  const auto correction = arrival_correction(unbent_normal(point), point.ng, wi);
  if (!correction) return;
  Spectrum flux = path.throughput * *correction;
  if (path.kind == kDirectPhotons && settings_.direct != nullptr)
    flux *= settings_.direct->weight_of_photon(from.light, from.state, from.start, {point.p, point.ng});
  photons.push_back(photon(path, from, vertex, flux, frames));
  count(photons.back());
  if (settings_.keep_seen && &photons == &trace_.photons) trace_.seen.push_back(path.seen);
}

void PhotonWriter::store_on_curve(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex,
                                  FrameSet frames) {
  trace_.on_curves.push_back({photon(path, from, vertex, path.throughput, frames),
                              StripPlace(vertex.shape, vertex.hit, vertex.wo), path.bounces});
  count(trace_.on_curves.back());
}

void PhotonWriter::store_in_medium(const PhotonPath& path, const PhotonOrigin& from, const MediumVertex& vertex) {
  const bool found_by_rays = settings_.rays_light_media && from.light.glow.medium == kNoMedium;
  if (path.kind == kDirectPhotons && found_by_rays) return;
  for (const MediumVertex::State& state : vertex.states) {
    const FrameSet frames = state.frames & path.frames;
    Spectrum flux = path.throughput * state.albedo;
    if (frames.empty() || is_black(flux)) continue;
    const StrandList strands = trace_.strands.folded(path.strands, frames, flux);
    trace_.in_media.push_back({vertex.point, -vertex.wo, flux, state.phase, frames, strands, from.index, vertex.medium,
                               path.wavelength.only_nm()});
    trace_.stored.add(frames.count());
    trace_.paths.weighted += strands != 0;
  }
}

Photon PhotonWriter::photon(const PhotonPath& path, const PhotonOrigin& from, const Vertex& vertex, Spectrum flux,
                            FrameSet frames) {
  const StrandList strands = trace_.strands.folded(path.strands, frames, flux);
  const ShapeFace face(vertex.hit.shape, vertex.point.ng, vertex.wo);
  return {vertex.point.p, face, vertex.wo, flux, frames, strands, from.index, path.wavelength.only_nm()};
}

void PhotonWriter::count(const Photon& stored) {
  trace_.stored.add(stored.frames.count());
  trace_.paths.weighted += stored.strands != 0;
}

}  // namespace dspm
