// A tree as devices traverse it: the nodes and leaves of tree.h behind plain pointers, the same tests one after the other
// instead of side by side. Answers are those of Tree, bit for bit, and depend on no order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "dspm/accel/box_ray.h"
#include "dspm/accel/bvh.h"
#include "dspm/accel/leaf_numbers.h"
#include "dspm/accel/meet.h"
#include "dspm/accel/nearest_hit.h"
#include "dspm/accel/ray_hit.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/base/math/bits.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/plain_shape.h"

namespace dspm {

struct PlainTree {
  /// A placed object: a shape with a tree in its own space, or one of a shape's primitives.
  struct Placed {
    Transform to_world;
    bool in_object_space = false;
    FrameSet frames;
    int number = 0;                   // of the shape, among all placed shapes
    const PlainTree* mesh = nullptr;  // null: it is a primitive of `shape`
    PlainShape shape = {};
    int primitive = 0;

    /// See plain_copy.h.
    template <class Fn>
    constexpr void each_array(Fn&& fn) {
      fn(mesh, 1);
      shape.each_array(fn);
    }
  };
  /// A shape whose primitives are the leaves kOfCrowd + first, ... + 1, ...
  struct Crowd {
    std::uint32_t first;
    Placed placed;

    /// See plain_copy.h.
    template <class Fn>
    constexpr void each_array(Fn&& fn) {
      placed.each_array(fn);
    }
  };

  const Bvh::Node* nodes = nullptr;
  const Bvh::NodeFrames* node_frames = nullptr;  // null: everything is there in all frames
  const TrianglePacket* packets = nullptr;
  const Placed* placed = nullptr;
  const Crowd* crowds = nullptr;
  const FrameSet* frames = nullptr;  // by shape
  std::uint32_t root = 0;
  float margins = 1;  // see Tree::margins()
  std::size_t node_count = 0, packet_count = 0, placed_count = 0, crowd_count = 0, shape_count = 0;

  constexpr bool empty() const { return nodes == nullptr; }
  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(nodes, node_count);
    fn(node_frames, node_count);
    fn(packets, packet_count);
    fn(placed, placed_count);
    fn(crowds, crowd_count);
    fn(frames, shape_count);
  }

  /// Returns the object in a leaf from kPlaced on, and sets which of its primitives it is.
  constexpr const Placed& placed_at(std::uint32_t leaf, int& primitive) const {
    if (leaf < kOfCrowd) return primitive = placed[leaf - kPlaced].primitive, placed[leaf - kPlaced];
    const Crowd* crowd = crowds + crowd_count - 1;
    while (crowd->first > leaf - kOfCrowd) --crowd;
    primitive = static_cast<int>(leaf - kOfCrowd - crowd->first);
    return crowd->placed;
  }
};

/// Returns bits of the children of `node` that the ray enters within `limit`, and sets the distances at which it does.
constexpr unsigned entered_children(const Bvh::Node& node, const BoxRay& ray, float limit, float* entry) {
  unsigned entered = 0;
  for (int i = 0; i < Bvh::kWidth; ++i) {
    float enter = 0, leave = limit;
    for (int axis = 0; axis < 3; ++axis) {
      const int low = ray.negative[static_cast<std::size_t>(axis)] ? 1 : 0;
      const float near = (node.planes[2 * axis + low][i] - ray.near_origin[axis]) * ray.inverse[axis];
      const float far = (node.planes[2 * axis + 1 - low][i] - ray.far_origin[axis]) * ray.inverse[axis];
      enter = near > enter ? near : enter;  // NaN, which is zero times infinity, changes nothing
      leave = far < leave ? far : leave;
    }
    entry[i] = enter;
    if (enter <= leave) entered |= 1u << i;
  }
  return entered;
}

/// Calls visit(leaf number) for the leaves that matter to `query`, a query of one frame (nearest_hit.h), roughly in the
/// order in which the ray enters them.
template <class Query, class Visit>
constexpr void traverse(const PlainTree& tree, const BoxRay& ray, Query& query, const Visit& visit) {
  static_assert(Query::kOneFrame);
  constexpr int kMost = (Bvh::kWidth - 1) * Bvh::kMaxDepth + 1;
  float at[kMost];
  std::uint32_t child[kMost];
  int size = 1;
  at[0] = 0, child[0] = tree.root;
  while (size > 0) {
    --size;
    if (at[size] > query.limit()) continue;
    const std::uint32_t top = child[size];
    if (top >= Bvh::kLeaf) {
      visit(top - Bvh::kLeaf);
      continue;
    }
    const Bvh::Node& node = tree.nodes[top];
    float entry[Bvh::kWidth];
    const int base = size;
    for (unsigned hits = entered_children(node, ray, query.limit(), entry); hits != 0; hits &= hits - 1) {
      const auto i = static_cast<std::size_t>(lowest_bit(hits));
      if (tree.node_frames != nullptr && (tree.node_frames[top][i] & query.frames()).empty()) continue;
      int place = size++;
      if constexpr (Query::kNearestFirst)
        for (; place > base && at[place - 1] < entry[i]; --place)
          at[place] = at[place - 1], child[place] = child[place - 1];
      at[place] = entry[i], child[place] = node.child[i];
    }
  }
}

/// The holes of shapes that have none. Whoever knows those of others has a class with the same function.
struct NoHoles {
  /// Returns what PlacedShape::stops() returns; `shape` is its number, the ray is in the world.
  static constexpr bool stops(int /*shape*/, const Ray& /*ray*/, int /*primitive*/, Vec2 /*uv*/) { return true; }
};

/// What a ray of the world passes through: the holes of all shapes, or those of the one in whose space it is.
template <class Holes>
struct RayInHoles {
  const Holes& holes;
  const Ray& world_ray;
  int whole = -1;

  constexpr bool stopped(int shape, int primitive, Vec2 uv) const {
    return holes.stops(whole < 0 ? shape : whole, world_ray, primitive, uv);
  }
};

template <class Query, class Holes>
constexpr void find_in(const TrianglePacket& packet, const MeshRay& ray, const FrameSet* frames, Query& query,
                       const RayInHoles<Holes>& in_holes) {
  for (std::size_t lane = 0; lane < TrianglePacket::kSize; ++lane) {
    const int shape = packet.shape[lane];
    if (shape < 0 || (frames[shape] & query.frames()).empty()) continue;
    PrimitiveHit hit;  // no std::optional: g++ would pass it through memory, slowly
    if (!meet(ray, packet.corner(lane, 0), packet.corner(lane, 1), packet.corner(lane, 2), hit)) continue;
    if (hit.t > query.limit() || !in_holes.stopped(shape, packet.primitive[lane], hit.uv)) continue;
    query.offer({hit.t, shape, packet.primitive[lane], hit.uv}, frames[shape] & query.frames());
  }
}

/// Calls fn(const TrianglePacket&) for those of a leaf.
template <class Fn>
constexpr void for_each_packet(const PlainTree& tree, std::uint32_t leaf, Fn&& fn) {
  const TrianglePacket* const first = tree.packets + (leaf & ~kTwo);
  fn(first[0]);
  if ((leaf & kTwo) != 0) fn(first[1]);
}

/// Returns whether the ray hits nothing because some of its numbers are none: it would enter all boxes.
constexpr bool is_nowhere(const BoxRay& ray) {
  const auto has_nan = [](const Vec3& v) { return v.x != v.x || v.y != v.y || v.z != v.z; };
  return has_nan(ray.near_origin) || has_nan(ray.inverse);
}

/// Offers what was found on the shape in its own space.
constexpr void pass_on(const NearestHit& own, int shape, FrameSet frames, NearestHit& query) {
  RayHit hit = own.hit();
  if (hit.missed()) return;
  hit.shape = shape;
  query.offer(hit, frames);
}
constexpr void pass_on(const AnyHit& own, int, FrameSet frames, AnyHit& query) {
  if (own.found()) query.offer({}, frames);
}

/// A ray prepared for trees of which none has more margins.
struct PlainRay {
  Ray ray;
  MeshRay mesh;
  BoxRay box;

  constexpr PlainRay(const Ray& r, float margins) : ray(r), mesh(r), box(r, margins) {}
};

/// Returns whether the ray enters one of the root's boxes within `limit`; if not, it hits nothing there.
constexpr bool enters(const PlainTree& tree, const PlainRay& ray, float limit) {
  float entry[Bvh::kWidth];
  return !tree.empty() && !is_nowhere(ray.box) && entered_children(tree.nodes[tree.root], ray.box, limit, entry) != 0;
}

/// Offers the ray's hits on triangles to `query`, and calls at(const PlainTree::Placed&, primitive) for the placed objects
/// that it may hit.
template <class Query, class Holes, class AtPlaced>
constexpr void find(const PlainTree& tree, const PlainRay& ray, Query& query, const RayInHoles<Holes>& in_holes,
                    const AtPlaced& at) {
  if (tree.empty() || is_nowhere(ray.box)) return;
  traverse(tree, ray.box, query, [&](std::uint32_t leaf) {
    if (leaf >= kPlaced) {
      int primitive = 0;
      const PlainTree::Placed& placed = tree.placed_at(leaf, primitive);
      return at(placed, primitive);
    }
    for_each_packet(tree, leaf,
                    [&](const TrianglePacket& packet) { find_in(packet, ray.mesh, tree.frames, query, in_holes); });
  });
}

/// Offers the hit on a primitive that stops the ray, which is in the shape's space.
template <class Query, class Holes>
constexpr void find_in(const PlainTree::Placed& placed, int primitive, FrameSet frames, const Ray& ray, Query& query,
                       const RayInHoles<Holes>& in_holes) {
  const auto hit = first_stop(placed.shape, primitive, ray, query.limit(),
                              [&](Vec2 uv) { return in_holes.stopped(placed.number, primitive, uv); });
  if (hit) query.offer({hit->t, placed.number, primitive, hit->uv}, frames);
}

/// Offers the ray's hits to `query`. Never inlined: a traversal's stack would take memory of a device once for each call.
template <class Query, class Holes>
[[gnu::noinline]] constexpr void find(const PlainTree& tree, const PlainRay& ray, Query& query, const Holes& holes) {
  const RayInHoles<Holes> in_holes{holes, ray.ray};
  find(tree, ray, query, in_holes, [&](const PlainTree::Placed& placed, int primitive) {
    const FrameSet frames = placed.frames & query.frames();
    if (frames.empty()) return;
    const Ray own_ray = placed.in_object_space ? placed.to_world.inverse_ray(ray.ray) : ray.ray;
    if (placed.mesh == nullptr) return find_in(placed, primitive, frames, own_ray, query, in_holes);
    const RayInHoles<Holes> in_own{holes, ray.ray, placed.number};
    const FrameSet only = FrameSet::single(0);
    Query own(only, query.limit());
    find(*placed.mesh, PlainRay(own_ray, placed.mesh->margins), own, in_own,
         [&](const PlainTree::Placed& part, int of_part) { find_in(part, of_part, only, own_ray, own, in_own); });
    pass_on(own, placed.number, frames, query);
  });
}

}  // namespace dspm
