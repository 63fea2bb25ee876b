// What holds of a surface of a body, and of bodies that overlap (nesting.h), for one state of each: the same for materials and
// for the plain bodies that a device has. A Body has priority().
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dspm/base/math/vec.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// Returns whether w leads into the body where its surface has that normal. `body` may be kNoBody.
constexpr bool leads_inside(int body, const Vec3& ng, const Vec3& w) { return body != kNoBody && dot(w, ng) < 0; }

/// Returns what a segment in direction w lies in, if the one that arrived there, along -wo, lay in `arriving`.
constexpr Inside inside_beyond(Inside arriving, int body, const Vec3& ng, const Vec3& wo, const Vec3& w) {
  if (leads_inside(body, ng, w) == leads_inside(body, ng, wo)) return arriving;
  if (leads_inside(body, ng, w))
    arriving.enter(body);
  else
    arriving.leave(body);
  return arriving;
}

/// Returns which of the bodies is there; null if none is. Bodies are given in the order in which they were entered, with null
/// for one that bounds no body.
template <class Body>
constexpr const Body* top_of(std::span<const Body* const> bodies) {
  const Body* top = nullptr;
  for (const Body* each : bodies)
    if (each != nullptr && (top == nullptr || each->priority() >= top->priority())) top = each;
  return top;
}

/// Returns that of the others that is around `own` where its surface is there; null if none of another priority is.
template <class Body>
constexpr const Body* body_around(const Body& own, std::span<const Body* const> others) {
  const Body* top = top_of(others);
  return top != nullptr && top->priority() != own.priority() ? top : nullptr;
}

/// The surface of a body as a path meets it.
template <class Body>
struct MetSurface {
  bool is_there = true;          // else it lies in a body of higher priority
  Inside arriving = {};          // the bodies that the path's segment lay in
  const Body* around = nullptr;  // see body_around(); null if the surface is not there
};

/// Returns what the surface of `body`, which is `own`, is to a path from within `inside`. `others` are the bodies of that list
/// without this one, and `states` what they are.
template <class Body>
constexpr MetSurface<Body> met_surface(int body, const Body& own, bool from_within, bool emits, const Inside& inside,
                                       std::span<const int> others, std::span<const Body* const> states) {
  MetSurface<Body> met{.arriving = inside};
  std::array<const Body*, Inside::kMost> left{};
  for (std::size_t i = 0; i < others.size(); ++i) left[i] = states[i];
  if (from_within && !inside.contains(body)) {
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (left[i] == nullptr || left[i]->priority() != own.priority()) continue;
      left[i] = nullptr;
      met.arriving.leave(others[i]);
    }
    met.arriving.enter(body);
  }
  const Body* around = body_around(own, std::span<const Body* const>(left.data(), others.size()));
  // What emits light is there in any case: it is a light, wherever it is.
  met.is_there = around == nullptr || around->priority() < own.priority() || emits;
  if (met.is_there) met.around = around;
  return met;
}

}  // namespace dspm
