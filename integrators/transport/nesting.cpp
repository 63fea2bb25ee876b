#include "dspm/integrators/transport/nesting.h"

#include <algorithm>

namespace dspm {
namespace {

/// Returns the boundary at the surface of a body in one of its states, `own`, given those of the others in the path's
/// list.
Boundary boundary_between(const Vertex& vertex, FrameSet frames, const Material& own, std::span<const int> others,
                          std::span<const Material* const> states, const Inside& inside) {
  Boundary boundary{frames, true, inside};
  std::array<const Material*, Inside::kMost> around{};
  std::copy(states.begin(), states.end(), around.begin());
  if (vertex.leads_inside(vertex.wo) && !inside.contains(vertex.body)) {
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (around[i] == nullptr || around[i]->priority() != own.priority()) continue;
      around[i] = nullptr;
      boundary.arriving.leave(others[i]);
    }
    boundary.arriving.enter(vertex.body);
  }
  const Material* top = top_of(std::span(around).first(others.size()));
  if (top == nullptr || top->priority() == own.priority()) return boundary;
  // What emits light is there in any case: it is a light, wherever it is.
  boundary.is_there = top->priority() < own.priority() || vertex.shape.light >= 0;
  if (!boundary.is_there) return boundary;
  boundary.outside_eta = top->eta();
  boundary.outside_dispersion = top->eta_at(vertex.point.wavelength) / top->eta();
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
