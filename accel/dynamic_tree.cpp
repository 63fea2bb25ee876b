#include "accel/dynamic_tree.h"

#include <map>
#include <type_traits>

namespace dspm {
namespace {

// Norm of a linear map where vectors are measured by their largest component.
template <class Map>
float norm(const Map& map) {
  return max_component(abs(map(Vec3{1, 0, 0})) + abs(map(Vec3{0, 1, 0})) + abs(map(Vec3{0, 0, 1})));
}

// For more frames than this the tree over all of them is faster. Measured on a galloping horse of 17K triangles.
constexpr int kFewFrames = 3;
// How often a triangle may be kept, on average, in the trees of single frames.
constexpr std::size_t kMostCopies = 2;

// By how much a rounding in the object's space, or on the way there, can be larger in the world than one that is made
// there: the condition of the transform. Twice that, as the margins of the object's space come on top of it.
float stretch_of(const Transform& t) {
  return 2 * norm([&](const Vec3& v) { return t.vector(v); }) *
         norm([&](const Vec3& v) { return t.inverse_vector(v); });
}

}  // namespace

DynamicTree::DynamicTree(std::span<const PlacedShape> shapes, const ShapesByKind& which, FrameSet all)
    : meshes_(shapes, which.meshes, all) {
  std::map<const Shape*, const ShapeTree*> trees;  // looked up only, so addresses decide nothing
  std::vector<Placed> placed;
  std::vector<Piece> pieces;
  for (const int s : which.others) {
    const PlacedShape& shape = shapes[static_cast<std::size_t>(s)];
    if (shape.shape->primitive_count() == 0) continue;
    const ShapeTree*& tree = trees[shape.shape];
    if (!tree) tree = shape_trees_.emplace_back(std::make_unique<ShapeTree>(*shape.shape)).get();
    placed.push_back({s, &shape, tree});
    pieces.push_back({place(placed.back()), shape.frames});
  }
  build_single_frames(shapes, which.meshes, all);
  bvh_ = build_bvh(pieces, 1, all);
  for (const Bvh::Leaf& leaf : bvh_.leaves) placed_.push_back(placed[bvh_.order[leaf.first]]);
  bvh_.forget_pieces();
}

void DynamicTree::build_single_frames(std::span<const PlacedShape> shapes, const std::vector<int>& meshes,
                                      FrameSet all) {
  std::size_t triangles = 0, copies = 0;
  for (const int s : meshes) {
    const PlacedShape& shape = shapes[static_cast<std::size_t>(s)];
    const auto count = static_cast<std::size_t>(shape.shape->primitive_count());
    triangles += count, copies += count * static_cast<std::size_t>((shape.frames & all).count());
  }
  if (triangles == 0 || copies > kMostCopies * triangles) return;
  for (Frame f = 0; f < kMaxFrames && all.contains(f); ++f) {
    std::vector<int> present;
    for (const int s : meshes)
      if (shapes[static_cast<std::size_t>(s)].frames.contains(f)) present.push_back(s);
    of_frame_.emplace_back(shapes, present, all);
  }
}

Bounds3 DynamicTree::place(const Placed& placed) {
  const Transform& to_world = placed.shape->to_world;
  Bounds3 world;
  for (const Bounds3& part : placed.tree->outline()) world.add(to_world.bounds(part));
  const float margins = stretch_of(to_world), origin = max_component(abs(to_world.point({})));
  margins_ = std::max(margins_, margins);
  return widened(world, margins * kBoxMargin * (largest_coordinate(world) + origin));
}

template <class Query>
void DynamicTree::find_in(const Placed& placed, const Ray& ray, Query& query) {
  const FrameSet frames = placed.shape->frames & query.frames();
  const Ray object_ray = placed.shape->in_object_space() ? placed.shape->to_world.inverse_ray(ray) : ray;
  if constexpr (std::is_same_v<Query, Unblocked>) {
    Unblocked unblocked(FrameSet::single(0), ray.t_max);
    placed.tree->find(object_ray, unblocked);
    if (unblocked.frames().empty()) query.offer({}, frames);
  } else {
    NearestHit nearest(FrameSet::single(0), query.limit(frames));
    placed.tree->find(object_ray, nearest);
    RayHit hit = nearest.hit();
    if (hit.missed()) return;
    hit.shape = placed.number;
    query.offer(hit, frames);
  }
}

template <class Query>
void DynamicTree::find(const Ray& ray, Query& query) const {
  walk(bvh_, BoxRay(ray, margins_), query, [&](std::uint32_t leaf) { find_in(placed_[leaf], ray, query); });
  if (meshes_.empty()) return;
  const MeshRay mesh_ray(ray);
  if (of_frame_.empty() || query.frames().count() > kFewFrames) return meshes_.find(mesh_ray, query);
  query.frames().for_each([&](Frame f) { of_frame_[static_cast<std::size_t>(f)].find(mesh_ray, query); });
}
template void DynamicTree::find(const Ray&, NearestHit&) const;
template void DynamicTree::find(const Ray&, NearestHits&) const;
template void DynamicTree::find(const Ray&, Unblocked&) const;

std::size_t DynamicTree::memory() const {
  std::size_t bytes = meshes_.memory() + bvh_.memory() + placed_.capacity() * sizeof(Placed);
  for (const auto& tree : shape_trees_) bytes += tree->memory();
  for (const TriangleTree& tree : of_frame_) bytes += tree.memory();
  return bytes;
}

}  // namespace dspm
