#include "dspm/integrators/photons/photon_map.h"

#include <algorithm>
#include <numeric>

#include "dspm/base/grid/counting_sort.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {
namespace {

/// The number of a trace's photons in each class; later, their places.
using Places = std::vector<std::size_t>;

/// Returns 0 for photons shared by frames, 1 + f for those of frame f alone, and the last number for those with
/// strands.
std::size_t class_of(const Photon& photon, std::size_t frames) {
  if (photon.strands != 0) return frames + 1;
  return photon.frames.count() > 1 ? 0 : static_cast<std::size_t>(photon.frames.lowest()) + 1;
}

template <class Fn>
void for_each_trace(const std::vector<PhotonTrace>& traces, Fn&& fn) {
  parallel_for(static_cast<std::int64_t>(traces.size()), 1, [&](std::int64_t t) { fn(static_cast<std::size_t>(t)); });
}

std::vector<Places> count(const std::vector<PhotonTrace>& traces, std::size_t frames,
                          std::vector<Photon> PhotonTrace::*which) {
  std::vector<Places> counts(traces.size());
  for_each_trace(traces, [&](std::size_t t) {
    counts[t].resize(frames + 2);
    if (frames == 1) {
      counts[t][0] = (traces[t].*which).size();
      return;
    }
    for (const Photon& photon : traces[t].*which) ++counts[t][class_of(photon, frames)];
  });
  return counts;
}

/// Returns whether most photons are shared: separate grids by frame do not pay off then.
bool mostly_common(const std::vector<Places>& counts) {
  std::size_t common = 0, all = 0;
  for (const Places& trace : counts) common += trace[0], all = std::accumulate(trace.begin(), trace.end() - 1, all);
  return 2 * common >= all;
}

}  // namespace

void PhotonMap::build(const std::vector<PhotonTrace>& traces, int frames, float cell_size) {
  build(traces, frames, cell_size, &PhotonTrace::photons);
}

void PhotonMap::build(const std::vector<PhotonTrace>& traces, int frame_count, float cell_size,
                      std::vector<Photon> PhotonTrace::*which) {
  const auto frames = static_cast<std::size_t>(frame_count);
  std::vector<Places> places = count(traces, frames, which);
  const bool by_frame = !mostly_common(places);
  if (!by_frame)
    for (Places& trace : places) {
      trace[0] = std::accumulate(trace.begin(), trace.end() - 1, std::size_t{0});
      std::fill(trace.begin() + 1, trace.end() - 1, 0);
    }
  Places begin(frames + 3);
  turn_into_places(places, begin);
  const std::size_t first_strands = begin[frames + 1];
  photons_.refit(begin.back());
  strands_.refit(begin.back() - first_strands);
  for_each_trace(traces, [&](std::size_t t) {
    for (const Photon& photon : traces[t].*which) {
      const std::size_t own = class_of(photon, frames), c = by_frame || own > frames ? own : 0;
      const std::size_t place = places[t][c]++;
      photons_[place] = &photon;
      // The lights' lists are the same in all traces.
      if (c > frames)
        strands_[place - first_strands] =
            traces[photon.strands < traces[t].own_strands ? 0 : t].strands.of(photon.strands);
    }
  });

  of_lights_ = {}, only_nm_ = traces.empty() ? std::int16_t{0} : traces[0].only_nm;
  if (!traces.empty()) of_lights_ = traces[0].strands.lists_before(traces[0].own_strands);

  const auto build = [&](PhotonGrid<GatheredPhoton>& grid, std::size_t first, std::size_t end) {
    const auto photon = [&, at = begin[first]](std::size_t i) -> const Photon& { return *photons_[at + i]; };
    const auto gathered = [&](std::size_t i) { return GatheredPhoton(photon(i)); };
    grid.build(begin[end] - begin[first], cell_size, photon, gathered, told_apart());
  };
  of_frame_.resize(by_frame ? frames : 0);
  // A grid of few photons cannot occupy all threads: build the grids in parallel.
  parallel_for(static_cast<std::int64_t>(of_frame_.size()) + 3, 1, [&](std::int64_t grid) {
    const auto i = static_cast<std::size_t>(grid);
    if (i == 0) build(common_, 0, 1);
    if (i == 1) build(single_, 1, frames + 1);
    if (i == 2) build_with_strands(first_strands, cell_size);
    if (i >= 3) build(of_frame_[i - 3], i - 2, i - 1);
  });
}

void PhotonMap::build_with_strands(std::size_t first, float cell_size) {
  const auto photon = [&](std::size_t i) -> const Photon& { return *photons_[first + i]; };
  const auto gathered = [&](std::size_t i) { return GatheredStrands(photon(i), strands_[i]); };
  with_strands_.build(strands_.size(), cell_size, photon, gathered, told_apart());
}

PlainPhotonMap PhotonMap::plain(std::vector<PlainPhotonGrid>& of_frame) const {
  of_frame.clear();
  for (const auto& grid : of_frame_) of_frame.push_back(grid.plain());
  return {common_.plain(), single_.plain(), of_frame.empty() ? nullptr : of_frame.data(), of_frame.size()};
}

std::size_t PhotonMap::bytes() const {
  std::size_t sum = photons_.bytes() + strands_.bytes() + common_.bytes() + single_.bytes() + with_strands_.bytes();
  for (const auto& grid : of_frame_) sum += grid.bytes();
  return sum;
}

}  // namespace dspm
