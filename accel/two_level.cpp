#include "dspm/accel/two_level.h"

#include <algorithm>
#include <set>

#include "dspm/accel/crowd.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

// For more frames than this, the tree over all of them is faster. Measured on a galloping horse of 17K triangles.
constexpr int kFewFrames = 3;
// The maximum average number of copies of a triangle in the trees of single frames.
constexpr std::size_t kMostCopies = 2;

bool in_some(const PlacedShape& s, FrameSet all) { return !s.frames.contains(all) && !(s.frames & all).empty(); }

/// Returns whether the trees of single frames would hold too many copies of triangles in world space.
bool live_too_long(std::span<const PlacedShape> shapes, FrameSet all) {
  std::size_t triangles = 0, copies = 0;
  for (const PlacedShape& shape : shapes) {
    if (shape.in_object_space() || !in_some(shape, all)) continue;
    const auto count = static_cast<std::size_t>(shape.shape->primitive_count());
    triangles += count, copies += count * static_cast<std::size_t>((shape.frames & all).count());
  }
  return copies > kMostCopies * triangles;
}

HitPartition one_part(FrameSet frames, const RayHit& hit) {
  HitPartition parts;
  parts.add(frames, hit);
  return parts;
}

}  // namespace

TwoLevel::TwoLevel(std::span<const PlacedShape> shapes, FrameSet all, BvhBuilder builder)
    : meshes_(builder, shapes),
      static_(shapes, numbers_of(shapes, [&](const PlacedShape& s) { return s.frames.contains(all); }), all, builder,
              meshes_),
      dynamic_(shapes, numbers_of(shapes, [&](const PlacedShape& s) { return in_some(s, all); }), all, BvhBuilder::own,
               meshes_),
      margins_(std::max(static_.margins(), dynamic_.margins())) {
  if (dynamic_.empty() || live_too_long(shapes, all)) return;
  of_frame_.resize(static_cast<std::size_t>(all.count()));
  parallel_for(all.count(), 1, [&](std::int64_t i) {
    const auto f = static_cast<Frame>(i);
    const auto there =
        numbers_of(shapes, [&](const PlacedShape& s) { return in_some(s, all) && s.frames.contains(f); });
    of_frame_[static_cast<std::size_t>(i)] = {shapes, there, FrameSet::single(f), BvhBuilder::own, meshes_};
  });
}

template <class Query>
void TwoLevel::find_dynamic(const TreeRay& ray, Query& query) const {
  if (of_frame_.empty() || query.frames().count() > kFewFrames) return dynamic_.find(ray, query);
  query.frames().for_each([&](Frame f) { of_frame_[static_cast<std::size_t>(f)].find(ray, query); });
}

HitPartition TwoLevel::partition(const Ray& ray, FrameSet frames) const {
  if (frames.empty()) return {};
  const TreeRay prepared(ray, margins_);
  NearestHit nearest(frames, ray.t_max);
  if (frames.count() == 1) {
    if (!dynamic_.empty()) find_dynamic(prepared, nearest);
    static_.find(prepared, nearest);
    return one_part(frames, nearest.hit());
  }
  static_.find(prepared, nearest);
  // Most rays end here, without the data structures for many frames.
  if (!dynamic_.enters(prepared, nearest.limit())) return one_part(frames, nearest.hit());
  NearestHits hits(frames, nearest.limit());
  if (!nearest.hit().missed()) hits.offer(nearest.hit(), frames);
  find_dynamic(prepared, hits);
  return hits.partition();
}

FrameSet TwoLevel::occluded(const Ray& ray, FrameSet frames) const {
  const TreeRay prepared(ray, margins_);
  AnyHit any(frames, ray.t_max);
  static_.find(prepared, any);
  if (any.found() || !dynamic_.enters(prepared, ray.t_max)) return any.found() ? frames : FrameSet();
  if (frames.count() == 1) {
    find_dynamic(prepared, any);
    return any.found() ? frames : FrameSet();
  }
  Unblocked unblocked(frames, ray.t_max);
  find_dynamic(prepared, unblocked);
  return frames - unblocked.frames();
}

std::size_t TwoLevel::memory() const {
  std::size_t bytes = meshes_.memory() + static_.memory() + dynamic_.memory();
  for (const Tree& tree : of_frame_) bytes += tree.memory();
  return bytes;
}

std::size_t two_level_bytes(std::span<const PlacedShape> shapes, FrameSet all) {
  // Bytes per triangle: those of cathedrals, horses and landscapes are 60 to 85, and about 40 more for a while. Pieces
  // of hair take less than half of that.
  constexpr std::size_t kKept = 95, kBuilding = 45;
  std::set<const Shape*> placed_meshes;
  std::size_t still = 0, moving = 0, in_trees_of_frames = 0;
  for (const PlacedShape& shape : shapes) {
    if (has_own_tree(shape) && !placed_meshes.insert(shape.shape).second) continue;
    const auto count = static_cast<std::size_t>(shape.shape->primitive_count()) / (is_crowd(*shape.shape) ? 2 : 1);
    (in_some(shape, all) ? moving : still) += count;
    if (in_some(shape, all) && !shape.in_object_space())
      in_trees_of_frames += count * static_cast<std::size_t>((shape.frames & all).count());
  }
  if (live_too_long(shapes, all)) in_trees_of_frames = 0;
  return kKept * (still + moving + in_trees_of_frames) + kBuilding * std::max({still, moving, in_trees_of_frames});
}

std::unique_ptr<Accel> make_two_level(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet all) {
  const std::string builder =
      reader.choice("static", "auto", {"auto", "embree", "own"},
                    "who builds the tree of what is static and those of placed meshes; auto: Embree if they are large");
  reader.finish();
  return std::make_unique<TwoLevel>(shapes, all,
                                    builder == "embree" ? BvhBuilder::embree
                                    : builder == "own"  ? BvhBuilder::own
                                                        : BvhBuilder::by_size);
}

}  // namespace dspm
