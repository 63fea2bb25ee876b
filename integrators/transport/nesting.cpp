#include "dspm/integrators/transport/nesting.h"

#include <algorithm>

namespace dspm {
namespace {

/// Returns the boundary at the surface of a body in one of its states, `own`, given those of the others in the path's
/// list.
Boundary boundary_between(const Vertex& vertex, FrameSet frames, const Material& own, std::span<const int> others,
                          std::span<const Material* const> states, const Inside& inside) {
  const MetSurface<Material> met =
      met_surface(vertex.body, own, vertex.leads_inside(vertex.wo), vertex.shape.light >= 0, inside, others, states);
  Boundary boundary{frames, met.is_there, met.arriving};
  if (met.around == nullptr) return boundary;
  boundary.outside_eta = met.around->eta();
  boundary.outside_dispersion = met.around->eta_at(vertex.point.wavelength) / met.around->eta();
  return boundary;
}

}  // namespace

FrameArray<Boundary> boundaries_of(const Scene& scene, const Vertex& vertex, const Inside& inside) {
  FrameArray<Boundary> boundaries;
  Inside others = inside;
  others.leave(vertex.body);
  if (vertex.body == kNoBody || others.is_empty()) {
    Boundary& only = boundaries.add({vertex.frames, true, inside});
    if (vertex.leads_inside(vertex.wo)) only.arriving.enter(vertex.body);
    return boundaries;
  }
  std::array<int, Inside::kMost + 1> bodies{vertex.body};
  std::copy(others.bodies().begin(), others.bodies().end(), bodies.begin() + 1);
  for_each_nesting(scene, std::span(bodies).first(others.bodies().size() + 1), vertex.frames,
                   [&](FrameSet frames, std::span<const Material* const> states) {
                     const Boundary boundary =
                         states[0] == nullptr
                             ? Boundary{frames, true, others}
                             : boundary_between(vertex, frames, *states[0], others.bodies(), states.subspan(1), inside);
                     for (Boundary& known : boundaries)
                       if (known.is_like(boundary)) return static_cast<void>(known.frames |= frames);
                     boundaries.add(boundary);
                   });
  return boundaries;
}

}  // namespace dspm
