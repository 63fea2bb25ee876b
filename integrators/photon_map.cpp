#include "integrators/photon_map.h"

#include <numeric>
#include <span>

#include "core/parallel.h"
#include "integrators/counting_sort.h"
#include "integrators/refit.h"

namespace dspm {
namespace {

/// For each class of photons how many a trace has, and later where they go.
using Places = std::vector<std::size_t>;

/// 0 for what frames have in common, 1 + f for what frame f has alone.
std::size_t class_of(const Photon& photon) {
  return photon.frames.count() > 1 ? 0 : static_cast<std::size_t>(photon.frames.lowest()) + 1;
}

template <class Fn>
void for_each_trace(const std::vector<PhotonTrace>& traces, Fn&& fn) {
  parallel_for(static_cast<std::int64_t>(traces.size()), 1, [&](std::int64_t t) { fn(static_cast<std::size_t>(t)); });
}

std::vector<Places> count(const std::vector<PhotonTrace>& traces, int frames) {
  std::vector<Places> counts(traces.size());
  for_each_trace(traces, [&](std::size_t t) {
    if (frames == 1) {
      counts[t] = {traces[t].photons.size()};
      return;
    }
    counts[t].resize(static_cast<std::size_t>(frames) + 1);
    for (const Photon& photon : traces[t].photons) ++counts[t][class_of(photon)];
  });
  return counts;
}

bool mostly_common(const std::vector<Places>& counts) {
  std::size_t common = 0, all = 0;
  for (const Places& trace : counts) common += trace[0], all = std::accumulate(trace.begin(), trace.end(), all);
  return 2 * common >= all;
}

}  // namespace

void PhotonMap::build(const std::vector<PhotonTrace>& traces, int frames, float cell_size) {
  std::vector<Places> places = count(traces, frames);
  const bool by_frame = !mostly_common(places);
  if (!by_frame)
    for (Places& trace : places) trace = {std::accumulate(trace.begin(), trace.end(), std::size_t{0})};
  const std::size_t classes = by_frame ? static_cast<std::size_t>(frames) + 1 : 1;
  Places begin(classes + 1);
  turn_into_places(places, begin);
  refit(photons_, begin.back());
  for_each_trace(traces, [&](std::size_t t) {
    for (const Photon& photon : traces[t].photons) photons_[places[t][by_frame ? class_of(photon) : 0]++] = &photon;
  });

  const auto photons_of = [&](std::size_t first, std::size_t end) {
    return std::span<const Photon* const>(photons_).subspan(begin[first], begin[end] - begin[first]);
  };
  of_frame_.resize(classes - 1);
  // A grid of few photons has no work for all threads: the grids are built side by side.
  parallel_for(static_cast<std::int64_t>(classes) + 1, 1, [&](std::int64_t grid) {
    const auto i = static_cast<std::size_t>(grid);
    if (i == 0) common_.build(photons_of(0, 1), cell_size);
    if (i == 1) single_.build(photons_of(1, classes), cell_size);
    if (i >= 2) of_frame_[i - 2].build(photons_of(i - 1, i), cell_size);
  });
}

std::size_t PhotonMap::bytes() const {
  std::size_t sum = photons_.capacity() * sizeof(Photon*) + common_.bytes() + single_.bytes();
  for (const PhotonGrid& grid : of_frame_) sum += grid.bytes();
  return sum;
}

}  // namespace dspm
