#include "dspm/accel/tree.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "dspm/accel/find_in_packet.h"
#include "dspm/accel/tree_limits.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/system/parallel.h"

namespace dspm {

Tree::Placed Tree::placed_at(std::uint32_t leaf) const {
  if (leaf < kOfCrowd) return placed_[leaf - kPlaced];
  const std::uint32_t at = leaf - kOfCrowd;
  const auto next =
      std::upper_bound(crowds_.begin(), crowds_.end(), at, [](auto place, const auto& c) { return place < c.first; });
  const PlacedCrowd& crowd = *(next - 1);
  return {crowd.shape, nullptr, crowd.number, static_cast<int>(at - crowd.first)};
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
    if (leaf >= kPlaced) return find_in(placed_at(leaf), ray.ray, query, whole);
    const TrianglePacket* packet = &packets_[leaf & ~kTwo];
    const TrianglePacket* const end = packet + ((leaf & kTwo) != 0 ? 2 : 1);
    for (; packet != end; ++packet) dspm::find_in(*packet, ray.four, offers, frames_of);
  });
}
template void Tree::find(const TreeRay&, NearestHit&) const;
template void Tree::find(const TreeRay&, NearestHits&) const;
template void Tree::find(const TreeRay&, AnyHit&) const;
template void Tree::find(const TreeRay&, Unblocked&) const;

std::size_t Tree::memory() const {
  return bvh_.memory() + packets_.capacity() * sizeof(TrianglePacket) + placed_.capacity() * sizeof(Placed) +
         crowds_.capacity() * sizeof(PlacedCrowd) + frames_.capacity() * sizeof(FrameSet);
}

// Many small trees are built at the same time, large ones one after the other by all threads.
MeshTrees::MeshTrees(BvhBuilder builder, std::span<const PlacedShape> shapes, const MeshTrees* known)
    : builder_(builder), known_(known) {
  constexpr int kLarge = 1 << 12;
  std::vector<std::pair<const Shape*, Own*>> small;
  for (const PlacedShape& placed : shapes) {
    if (!has_own_tree(placed) || this->known(*placed.shape) != nullptr) continue;
    const auto [own, is_new] = trees_.try_emplace(placed.shape);
    if (is_new && placed.shape->primitive_count() < kLarge) small.emplace_back(placed.shape, &own->second);
  }
  parallel_for(static_cast<std::int64_t>(small.size()), 1, [&](std::int64_t i) {
    const auto& [mesh, own] = small[static_cast<std::size_t>(i)];
    build(*mesh, *own);
  });
  for (auto& [mesh, own] : trees_)
    if (!own.tree) build(*mesh, own);
}

void MeshTrees::build(const Shape& mesh, Own& own) {
  const FrameSet only = FrameSet::single(0);
  own.placed = {.shape = &mesh, .to_world = {}, .frames = only};
  const int first = 0;
  own.tree = std::make_unique<const Tree>(std::span(&own.placed, 1), std::span(&first, 1), only, builder_, *this);
}

const Tree* MeshTrees::known(const Shape& mesh) const {
  if (known_ == nullptr) return nullptr;
  const auto found = known_->trees_.find(&mesh);
  return found != known_->trees_.end() ? found->second.tree.get() : known_->known(mesh);
}

const Tree& MeshTrees::of(const Shape& mesh) {
  if (const Tree* const made = known(mesh)) return *made;
  Own& own = trees_[&mesh];
  if (!own.tree) build(mesh, own);
  return *own.tree;
}

std::size_t MeshTrees::memory() const {
  std::size_t bytes = 0;
  for (const auto& [shape, own] : trees_) bytes += own.tree->memory();
  return bytes;
}

}  // namespace dspm
