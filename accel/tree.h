// The tree over placed shapes. Its nodes store the frames in which their contents exist. A leaf holds up to eight
// triangles of meshes in world space, or one object placed by a transform: a single primitive, or a whole mesh or hair,
// which then has one tree in its own space, however often it is placed. As the meshes of a deforming object lie close
// together, leaves and nodes hold triangles of several frames.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "dspm/accel/bvh.h"
#include "dspm/accel/cut_query.h"
#include "dspm/accel/four_triangles.h"
#include "dspm/accel/traverse.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/system/untouched.h"

namespace dspm {

class MeshTrees;
class PlainTrees;

/// A ray prepared for trees whose Tree::margins() is at most `margins`.
struct TreeRay {
  Ray ray;
  FourRays four;
  NodeTest test;

  TreeRay(const Ray& r, float margins) : ray(r), four(r), test(margins == 1 ? four.one.box : BoxRay(r, margins)) {}
};

/// Returns the numbers of the shapes for which wanted(PlacedShape) holds.
template <class Wanted>
std::vector<int> numbers_of(std::span<const PlacedShape> shapes, const Wanted& wanted) {
  std::vector<int> numbers;
  for (std::size_t s = 0; s < shapes.size(); ++s)
    if (wanted(shapes[s])) numbers.push_back(static_cast<int>(s));
  return numbers;
}

/// Returns whether the shape has one tree in its own space, however often it is placed: a shape of several primitives
/// does.
inline bool has_own_tree(const PlacedShape& shape) {
  return shape.in_object_space() && (shape.shape->triangles() || shape.shape->primitive_count() > 1);
}

/// Returns whether the shape's triangles lie in a tree as they are, among those of others.
inline bool is_world_mesh(const PlacedShape& shape) { return shape.shape->triangles() && !shape.in_object_space(); }

class Tree {
 public:
  Tree() = default;
  /// Builds a tree over shapes[i] for all i in `which`. `all` are the frames that rays may query. If the shapes are
  /// there in all of them, `builder` builds the tree; otherwise our own does, which knows frames.
  Tree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all, BvhBuilder builder,
       MeshTrees& meshes);

  /// Returns this tree over other shapes, whose boxes it takes on: each of those that it holds is one of the same number
  /// of primitives, in the same frames, stored in the same way. There must be no crowd.
  Tree refitted(std::span<const PlacedShape> shapes, MeshTrees& meshes) const;
  bool has_crowds() const { return !crowds_.empty(); }

  bool empty() const { return bvh_.nodes.empty(); }
  /// Offers the ray's hits to `query`, one of those in hits.h.
  template <class Query>
  void find(const TreeRay& ray, Query& query) const;
  /// The number of margins that its boxes need around a ray's origin: more than one if a transform stretches errors.
  float margins() const { return margins_; }

  /// Returns whether the ray enters one of the root's boxes within `limit`; if not, it hits nothing there.
  bool enters(const TreeRay& ray, float limit) const { return enters_root(bvh_, ray.test, limit); }

  /// Returns up to 8 boxes, with margin, that together contain everything.
  std::vector<Bounds3> outline() const { return empty() ? std::vector<Bounds3>{} : bvh_.root_node().boxes(); }
  /// The bytes without the trees of placed meshes.
  std::size_t memory() const;

 private:
  friend class PlainTrees;

  /// A placed object: one primitive, or all of a shape.
  struct Placed {
    const PlacedShape* shape;
    const Tree* mesh;  // null for a primitive
    int number;        // of the shape, among all placed shapes
    int primitive;
  };
  /// A shape whose primitives are the leaves kOfCrowd + first, ... + 1, ...
  struct PlacedCrowd {
    std::uint32_t first;
    const PlacedShape* shape;
    int number;
  };
  class Builder;

  Placed placed_at(std::uint32_t leaf) const;
  std::vector<Bounds3> move_packets(std::span<const PlacedShape> shapes);
  std::vector<Bounds3> move_placed(std::span<const PlacedShape> shapes, MeshTrees& meshes);

  /// The shape whose own tree this is, if it is placed with holes, and the ray before it was transformed.
  struct CutOut {
    const PlacedShape& placed;
    const Ray& world_ray;
  };

  /// Offers hits on triangles to `offers`, the others to `query`. `whole` is null if there are no holes.
  template <class Query, class Offers>
  void find(const TreeRay& ray, Query& query, Offers& offers, const CutOut* whole = nullptr) const;
  template <class Query>
  void find_in(const Placed& placed, const Ray& ray, Query& query, const CutOut* whole) const;
  /// Finds hits on a mesh in its own space, placed as `placed`; `world_ray` is the ray before it was transformed.
  template <class Query>
  void find_placed(const Ray& ray, Query& query, const PlacedShape& placed, const Ray& world_ray) const;

  Bvh bvh_;  // leaf numbers index packets_, from kPlaced on placed_, from kOfCrowd on primitives of crowds_
  UntouchedVector<TrianglePacket> packets_;
  std::vector<Placed> placed_;
  std::vector<PlacedCrowd> crowds_;
  std::vector<FrameSet> frames_;          // by shape
  float margins_ = 1;                     // see stretch_of()
  const PlacedShape* cut_out_ = nullptr;  // all shapes, if one with triangles in world space has holes
};

/// A tree, in its own space, for each shape of several primitives that is placed by a transform.
class MeshTrees {
 public:
  explicit MeshTrees(BvhBuilder builder) : builder_(builder) {}
  /// Builds the trees of these shapes that `known` lacks; afterwards, of() may be called by several threads. `known` may
  /// be null, else it outlives this.
  MeshTrees(BvhBuilder builder, std::span<const PlacedShape> shapes, const MeshTrees* known = nullptr);
  const Tree& of(const Shape& mesh);
  std::size_t memory() const;

 private:
  struct Own {
    PlacedShape placed;  // where it is; the tree's primitives refer to it
    std::unique_ptr<const Tree> tree;
  };

  void build(const Shape& mesh, Own& own);
  const Tree* known(const Shape& mesh) const;

  BvhBuilder builder_;
  const MeshTrees* known_ = nullptr;
  std::map<const Shape*, Own> trees_;  // lookups only, so addresses affect no result
};

}  // namespace dspm
