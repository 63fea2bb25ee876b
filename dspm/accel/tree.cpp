#include "dspm/accel/tree.h"

#include <algorithm>
#include <type_traits>

#include "dspm/accel/tree_limits.h"
#include "dspm/accel/triangle_pieces.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

// From here on, Embree's builder is faster, even as it starts its threads.
constexpr std::size_t kManyPieces = 5000;

// Norm of a linear map, with vectors measured by their largest component.
template <class Map>
float norm(const Map& map) {
  return max_component(abs(map(Vec3{1, 0, 0})) + abs(map(Vec3{0, 1, 0})) + abs(map(Vec3{0, 0, 1})));
}

// How much larger a rounding error in object space, or on the way there, can be in world space than one made there: the
// condition number of the transform. Doubled, since the margins of object space come on top of it.
float stretch_of(const Transform& t) {
  return 2 * norm([&](const Vec3& v) { return t.vector(v); }) *
         norm([&](const Vec3& v) { return t.inverse_vector(v); });
}

bool is_world_mesh(const PlacedShape& s) { return s.shape->triangles() && !s.in_object_space(); }

}  // namespace

class Tree::Builder {
 public:
  Builder(Tree& tree, std::span<const PlacedShape> shapes, MeshTrees& meshes)
      : tree_(tree), shapes_(shapes), meshes_(meshes) {}

  void build(std::span<const int> which, FrameSet all, BvhBuilder builder) {
    std::vector<int> world_meshes;
    for (const int s : which)
      if (is_world_mesh(shape(s))) world_meshes.push_back(s);
    TrianglePieces triangles(shapes_, world_meshes);
    pieces_ = std::move(triangles.pieces);
    for (const int s : which)
      if (!is_world_mesh(shape(s))) place(s);
    expect_numbered(pieces_.size(), 0);

    const bool alike =
        std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.frames.contains(all); });
    if (builder == BvhBuilder::by_size) builder = pieces_.size() < kManyPieces ? BvhBuilder::own : BvhBuilder::embree;
    tree_.bvh_ = alike && builder == BvhBuilder::embree ? build_bvh_with_embree(pieces_, kLeafSize)
                                                        : build_bvh(pieces_, kLeafSize, all);
    if (alike) tree_.bvh_.node_frames = {};
    pieces_ = {};  // frees memory for the packets
    tree_.bvh_.nodes.shrink_to_fit();
    const std::size_t packets = packets_in(triangles);
    expect_numbered(triangles.count(), packets);
    tree_.packets_.reserve(packets), tree_.placed_.reserve(placed_.size());
    for (Bvh::Node& node : tree_.bvh_.nodes)
      for (std::uint32_t& child : node.child)
        if (child >= Bvh::kLeaf) child = Bvh::kLeaf + add_leaf(tree_.bvh_.leaves[child - Bvh::kLeaf], triangles);
    tree_.bvh_.forget_pieces();
  }

 private:
  const PlacedShape& shape(int s) const { return shapes_[static_cast<std::size_t>(s)]; }

  /// What the boxes of a placed shape need: the same for all of its primitives, of which hair has millions.
  struct ToWorld {
    explicit ToWorld(const Transform& t)
        : transform(t), margins(stretch_of(t)), origin(max_component(abs(t.point({})))) {}
    const Transform& transform;
    float margins, origin;
  };

  void place(int s) {
    const PlacedShape& placed = shape(s);
    const ToWorld to_world(placed.to_world);
    tree_.margins_ = std::max(tree_.margins_, to_world.margins);
    if (has_own_tree(placed)) {
      const Tree& mesh = meshes_.of(*placed.shape);
      placed_.push_back({&placed, &mesh, s, 0});
      pieces_.push_back(piece_of(placed, to_world, mesh.outline()));
      return;
    }
    add_primitives(placed, s, to_world);
  }

  void add_primitives(const PlacedShape& placed, int s, const ToWorld& to_world) {
    const int count = placed.shape->primitive_count();
    const std::size_t first_piece = pieces_.size(), first_placed = placed_.size();
    pieces_.resize(first_piece + static_cast<std::size_t>(count));
    placed_.resize(first_placed + static_cast<std::size_t>(count));
    const auto add_one = [&](std::int64_t p) {
      const auto i = static_cast<std::size_t>(p);
      placed_[first_placed + i] = {&placed, nullptr, s, static_cast<int>(p)};
      const Bounds3 box = with_margin(placed.shape->bounds(static_cast<int>(p)));
      pieces_[first_piece + i] = piece_of(placed, to_world, std::span(&box, 1));
    };
    parallel_for(count, 1 << 12, add_one);
  }

  /// One that fills a leaf. `outline`: in the shape's space.
  static Piece piece_of(const PlacedShape& placed, const ToWorld& to_world, std::span<const Bounds3> outline) {
    Bounds3 world;
    for (const Bounds3& part : outline) world.add(to_world.transform.bounds(part));
    world = widened(world, to_world.margins * kBoxMargin * (largest_coordinate(world) + to_world.origin));
    return {world, placed.frames, kLeafSize};
  }

  std::uint32_t add_leaf(const Bvh::Leaf& leaf, const TrianglePieces& triangles) {
    const auto pieces = std::span(tree_.bvh_.order).subspan(leaf.first, leaf.count);
    if (pieces.front() >= triangles.count()) {
      tree_.placed_.push_back(placed_[pieces.front() - triangles.count()]);
      return kPlaced + static_cast<std::uint32_t>(tree_.placed_.size() - 1);
    }
    const auto first = static_cast<std::uint32_t>(tree_.packets_.size());
    std::size_t count = 0;
    for (const std::uint32_t piece : pieces) {
      for (const auto [s, number] : triangles.of_piece(piece)) {
        const std::size_t lane = count++ % TrianglePacket::kSize;
        if (lane == 0) tree_.packets_.emplace_back();
        const TriangleMesh& mesh = *shape(s).shape->triangles();
        tree_.packets_.back().set(lane, s, number, mesh.vertex(number, 0), mesh.vertex(number, 1),
                                  mesh.vertex(number, 2));
      }
    }
    return count > TrianglePacket::kSize ? kTwo | first : first;
  }

  /// The packets that the leaves will take.
  std::size_t packets_in(const TrianglePieces& triangles) const {
    std::size_t packets = 0;
    for (const Bvh::Leaf& leaf : tree_.bvh_.leaves) {
      std::size_t count = 0;
      for (const std::uint32_t piece : std::span(tree_.bvh_.order).subspan(leaf.first, leaf.count))
        if (piece < triangles.count()) count += triangles.of_piece(piece).size();
      packets += (count + TrianglePacket::kSize - 1) / TrianglePacket::kSize;
    }
    return packets;
  }

  Tree& tree_;
  std::span<const PlacedShape> shapes_;
  MeshTrees& meshes_;
  std::vector<Piece> pieces_;  // triangles, then placed_
  std::vector<Placed> placed_;
};

Tree::Tree(std::span<const PlacedShape> shapes, std::span<const int> which, FrameSet all, BvhBuilder builder,
           MeshTrees& meshes) {
  for (const PlacedShape& placed : shapes) frames_.push_back(placed.frames);
  Builder(*this, shapes, meshes).build(which, all, builder);
  for (const int s : which) {
    const PlacedShape& placed = shapes[static_cast<std::size_t>(s)];
    if (is_world_mesh(placed) && placed.cutout != nullptr) cut_out_ = shapes.data();
  }
}

template <class Query>
void Tree::find_in(const Placed& placed, const Ray& ray, Query& query, const CutOut* whole) const {
  const FrameSet frames = placed.shape->frames & query.frames();
  Ray object_ray = placed.shape->in_object_space() ? placed.shape->to_world.inverse_ray(ray) : ray;
  if (!placed.mesh) {
    const PlacedShape& cut = whole != nullptr ? whole->placed : *placed.shape;
    const auto hit = cut.cutout == nullptr
                         ? meet(*placed.shape->shape, placed.primitive, object_ray)
                         : first_stop(cut, placed.primitive, whole != nullptr ? whole->world_ray : ray, object_ray,
                                      query.limit(frames));
    if (hit) query.offer({hit->t, placed.number, placed.primitive, hit->uv}, frames);
  } else if constexpr (std::is_same_v<Query, Unblocked> || std::is_same_v<Query, AnyHit>) {
    AnyHit any(FrameSet::single(0), ray.t_max);
    placed.mesh->find_placed(object_ray, any, *placed.shape, ray);
    if (any.found()) query.offer({}, frames);
  } else {
    NearestHit nearest(FrameSet::single(0), query.limit(frames));
    placed.mesh->find_placed(object_ray, nearest, *placed.shape, ray);
    RayHit hit = nearest.hit();
    if (hit.missed()) return;
    hit.shape = placed.number;
    query.offer(hit, frames);
  }
}

template <class Query>
void Tree::find_placed(const Ray& ray, Query& query, const PlacedShape& placed, const Ray& world_ray) const {
  const TreeRay prepared(ray, margins_);
  if (placed.cutout == nullptr) return find(prepared, query, query);
  CutQuery<Query> cut(query, world_ray, &placed);
  const CutOut whole{placed, world_ray};
  find(prepared, query, cut, &whole);
}

template <class Query>
void Tree::find(const TreeRay& ray, Query& query) const {
  if (cut_out_ == nullptr) return find(ray, query, query);
  CutQuery<Query> cut(query, ray.ray, cut_out_);
  find(ray, query, cut);
}

template <class Query, class Offers>
void Tree::find(const TreeRay& ray, Query& query, Offers& offers, const CutOut* whole) const {
  const auto frames_of = [&](int shape) { return frames_[static_cast<std::size_t>(shape)]; };
  traverse(bvh_, ray.test, query, [&](std::uint32_t leaf) {
    if (leaf >= kPlaced) return find_in(placed_[leaf - kPlaced], ray.ray, query, whole);
    const TrianglePacket* packet = &packets_[leaf & ~kTwo];
    const TrianglePacket* const end = packet + ((leaf & kTwo) != 0 ? 2 : 1);
    for (; packet != end; ++packet) packet->find(ray.four, offers, frames_of);
  });
}
template void Tree::find(const TreeRay&, NearestHit&) const;
template void Tree::find(const TreeRay&, NearestHits&) const;
template void Tree::find(const TreeRay&, AnyHit&) const;
template void Tree::find(const TreeRay&, Unblocked&) const;

std::size_t Tree::memory() const {
  return bvh_.memory() + packets_.capacity() * sizeof(TrianglePacket) + placed_.capacity() * sizeof(Placed) +
         frames_.capacity() * sizeof(FrameSet);
}

const Tree& MeshTrees::of(const Shape& mesh) {
  Own& own = trees_[&mesh];
  if (!own.tree) {
    const FrameSet only = FrameSet::single(0);
    own.placed = {.shape = &mesh, .to_world = {}, .frames = only};
    const int first = 0;
    own.tree = std::make_unique<const Tree>(std::span(&own.placed, 1), std::span(&first, 1), only, builder_, *this);
  }
  return *own.tree;
}

std::size_t MeshTrees::memory() const {
  std::size_t bytes = 0;
  for (const auto& [shape, own] : trees_) bytes += own.tree->memory();
  return bytes;
}

}  // namespace dspm
