// The project's tree over placed shapes. Its nodes know in which frames their contents are there. A leaf holds up to
// eight triangles of meshes that stand in world space, or something that a transform places: one primitive, or a whole
// mesh, which then has a tree of its own in its own space, however often it is placed. As the meshes of a deforming
// object lie close together, leaves and nodes hold triangles of several frames.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "dspm/accel/traverse.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"

namespace dspm {

class MeshTrees;

/// A ray prepared for trees whose margins (Tree::margins) are no more than `margins`.
struct TreeRay {
  Ray ray;
  FourRays four;
  NodeTest test;

  TreeRay(const Ray& r, float margins) : ray(r), four(r), test(margins == 1 ? four.one.box : BoxRay(r, margins)) {}
};

/// Numbers of the shapes for which wanted(PlacedShape) holds.
template <class Wanted>
std::vector<int> numbers_of(std::span<const PlacedShape> shapes, const Wanted& wanted) {
  std::vector<int> numbers;
  for (std::size_t s = 0; s < shapes.size(); ++s)
    if (wanted(shapes[s])) numbers.push_back(static_cast<int>(s));
  return numbers;
}

class Tree {
 public:
  /// Over shapes[i] for all i in `which`. `all`: the frames that rays may ask for.
  Tree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all, MeshTrees& meshes);

  bool empty() const { return bvh_.nodes.empty(); }
  /// Offers to `query`, one of those in hits.h, what the ray meets.
  template <class Query>
  void find(const TreeRay& ray, Query& query) const;
  /// How many margins of a ray's origin its boxes need: more than one where a transform stretches errors.
  float margins() const { return margins_; }

  /// Whether the ray enters one of the root's boxes within `limit`: if not, it meets nothing there.
  bool enters(const TreeRay& ray, float limit) const { return enters_root(bvh_, ray.test, limit); }

  /// Boxes of up to 8 parts, with margin, that are all there is.
  std::vector<Bounds3> outline() const { return empty() ? std::vector<Bounds3>{} : bvh_.nodes.front().boxes(); }
  /// Without the trees of placed meshes.
  std::size_t memory() const;

 private:
  /// One primitive, or all of a mesh.
  struct Placed {
    int number;  // among all placed shapes
    const PlacedShape* shape;
    const Tree* mesh;  // null: it is a primitive
    int primitive;
  };
  class Builder;

  template <class Query>
  void find_in(const Placed& placed, const Ray& ray, Query& query) const;

  Bvh bvh_;  // leaf numbers index packets_, from kPlaced on placed_
  std::vector<TrianglePacket> packets_;
  std::vector<Placed> placed_;
  std::vector<FrameSet> frames_;  // by shape
  float margins_ = 1;             // see stretch_of()
};

/// A tree for each mesh that is placed by a transform, in the mesh's own space.
class MeshTrees {
 public:
  const Tree& of(const Shape& mesh);
  std::size_t memory() const;

 private:
  std::map<const Shape*, std::unique_ptr<const Tree>> trees_;  // looked up only, so addresses decide nothing
};

}  // namespace dspm
