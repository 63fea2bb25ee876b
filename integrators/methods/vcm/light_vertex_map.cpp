#include "dspm/integrators/methods/vcm/light_vertex_map.h"

#include "dspm/base/system/parallel.h"

namespace dspm {

void LightVertexMap::build(const std::vector<LightTrace>& traces, int frames, const Radii& radii) {
  sorted_.resize(frames == 1 ? 1 : static_cast<std::size_t>(frames) + 1);
  for (std::vector<Placed>& vertices : sorted_) vertices.clear();
  to_media_.clear();
  for (const LightTrace& trace : traces)
    for (const LightVertex& vertex : trace.vertices) {
      if (vertex.merging == 0) continue;
      const bool common = frames == 1 || vertex.frames.count() > 1;
      std::vector<Placed>& among = vertex.medium != kNoMedium ? to_media_
                                   : common                   ? sorted_[0]
                                            : sorted_[static_cast<std::size_t>(vertex.frames.lowest()) + 1];
      among.push_back({&vertex, trace.strands.of(vertex.strands)});
    }
  on_curves_.build(traces);
  build(in_media_, to_media_, radii.in_media);
  of_frame_.resize(sorted_.size() - 1);
  parallel_for(static_cast<std::int64_t>(sorted_.size()), 1, [&](std::int64_t i) {
    const auto grid = static_cast<std::size_t>(i);
    build(grid == 0 ? common_ : of_frame_[grid - 1], sorted_[grid], radii.on_surfaces);
  });
}

void LightVertexMap::build(PhotonGrid<Placed>& grid, const std::vector<Placed>& vertices, float radius) {
  grid.build(
      vertices.size(), radius, [&](std::size_t i) -> const LightVertex& { return *vertices[i].vertex; },
      [&](std::size_t i) { return vertices[i]; });
}

std::size_t LightVertexMap::bytes() const {
  std::size_t sum = common_.bytes() + in_media_.bytes() + to_media_.capacity() * sizeof(Placed) + on_curves_.bytes();
  for (const auto& grid : of_frame_) sum += grid.bytes();
  for (const auto& vertices : sorted_) sum += vertices.capacity() * sizeof(Placed);
  return sum;
}

}  // namespace dspm
