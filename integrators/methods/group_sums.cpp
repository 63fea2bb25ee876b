#include "dspm/integrators/methods/group_sums.h"

#include <algorithm>
#include <array>

#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/gather_beams.h"

namespace dspm {

GroupSums::GroupSums(const EstimatorSettings& of, const PixelEstimator& whole, const Scene& scene,
                     const std::vector<std::string>& asked)
    : groups_(scene, asked),
      infos_(light_group_outputs(scene)),
      of_(of),
      whole_(whole),
      sums_(std::int64_t{groups_.count()} * of.pixels, of.frames) {}

void GroupSums::see(std::span<const HitPointTile> tiles) {
  if (sums_.empty()) return;
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t t) {
    for (const SeenLight& light : tiles[static_cast<std::size_t>(t)].seen) {
      if (light.caught) continue;
      for (const int group : {groups_.of_light(light.light), light.of_media ? groups_.of_media() : LightGroups::kNone})
        if (group != LightGroups::kNone)
          light.frames.for_each([&](Frame f) {
            sums_.at(row(group, light.pixel), f) += light.radiance * static_cast<float>(of_.photons);
          });
    }
  });
}

void GroupSums::gather(const PhotonBatch& batch, BatchCounts& counts) {
  if (sums_.empty()) return;
  gather_tiles(batch.tiles, counts.photons, [&](const HitPointTile& tile, GatherCounts&) {
    GatherCounts not_counted;
    for (const HitPoint& hit : tile.glossy) {
      if (hit.caught) continue;
      const float radius2 = of_.radius->squared(hit.radius);
      gather_at(
          hit, tile, batch.hidden.on_surfaces, radius2, [radius2](Frame) { return radius2; },
          [&](auto&& fn) { gather_hidden_by_group(hit, tile, batch.hidden, radius2, not_counted, fn); });
    }
    for (const CameraBeam& beam : tile.beams)
      gather_beam_by_group(beam, tile, batch.in_media, of_.radius->of(1), groups_,
                           [&](FrameSet frames, const Spectrum& radiance, int group) {
                             const Rgb seen = tile.palette->seen(radiance);
                             frames.for_each([&](Frame f) { sums_.at(row(group, beam.pixel), f) += seen; });
                           });
    for (const HitPoint& hit : tile.hit_points) {
      if (hit.caught) continue;
      const float widest2 = whole_.search_radius2(hit);
      gather_at(
          hit, tile, batch.photons, widest2, [&](Frame f) { return whole_.search_radius2_in(f, hit); },
          [&](auto&& fn) { gather_by_group(hit, tile.scattering_of(hit), batch.photons, widest2, not_counted, fn); });
    }
  });
}

/// `radius2(Frame)` returns the square of the radius in that frame; `widest2` is the largest of them, within which
/// gather(fn) finds photons.
template <class Radius2, class Gather>
void GroupSums::gather_at(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& map, float widest2,
                          Radius2&& radius2, Gather&& gather) {
  std::array<float, kMaxFrames> within2;
  float narrowest2 = widest2;
  hit.frames.for_each([&](Frame f) {
    const float own2 = within2[static_cast<std::size_t>(f)] = radius2(f);
    narrowest2 = std::min(narrowest2, own2);
  });
  const auto reached = [&](FrameSet frames, float distance2) {
    FrameSet within;
    frames.for_each([&](Frame f) {
      if (distance2 <= within2[static_cast<std::size_t>(f)]) within |= FrameSet::single(f);
    });
    return within;
  };

  std::vector<GatheredFlux> by_group;
  by_group.reserve(static_cast<std::size_t>(groups_.count()));
  for (int group = 0; group < groups_.count(); ++group) by_group.emplace_back(hit, map);
  gather([&](const Strand* strands, FrameSet frames, SpectrumLanes flux, float distance2, const auto& group) {
    if (const int own = group(); own != LightGroups::kNone)
      by_group[static_cast<std::size_t>(own)].add(strands,
                                                  distance2 <= narrowest2 ? frames : reached(frames, distance2), flux);
  });

  for (int group = 0; group < groups_.count(); ++group) {
    GatheredFlux& flux = by_group[static_cast<std::size_t>(group)];
    flux.end();
    for_each_strand(tile.strands.of(hit.strands), hit.frames, [&](FrameSet frames, const Spectrum& weight) {
      frames.for_each([&](Frame f) {
        const Spectrum per_area = hit.throughput * weight / kernel_size(within2[static_cast<std::size_t>(f)]);
        sums_.at(row(group, hit.pixel), f) += tile.palette->seen(flux.in(f)*per_area);
      });
    });
  }
}

std::vector<PixelOutput> GroupSums::outputs(int iterations) const {
  std::vector<PixelOutput> outputs;
  const double paths = static_cast<double>(iterations * of_.photons);
  for (const OutputInfo& info : infos_)
    outputs.push_back({info, [this, paths, group = groups_.of_output(info.name)](int pixel, Frame frame) {
                         if (paths == 0 || group == LightGroups::kNone) return Rgb();
                         return sums_.at(row(group, pixel), frame) * static_cast<float>(1 / paths);
                       }});
  return outputs;
}

}  // namespace dspm
