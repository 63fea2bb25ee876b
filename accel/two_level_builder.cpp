// Builds a TwoLevel, or makes one from that of the same frames at another time.
#include <algorithm>
#include <utility>

#include "dspm/accel/dynamic_shapes.h"
#include "dspm/accel/two_level.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"

namespace dspm {

struct TwoLevel::Fixed {
  Fixed(std::span<const PlacedShape> shapes, FrameSet all, BvhBuilder builder)
      : all_shapes(shapes),
        numbers(numbers_of(shapes, [&](const PlacedShape& s) { return is_static(s, all); })),
        meshes(builder, shapes),
        tree(shapes, numbers, all, builder, meshes) {}

  bool is_in(std::span<const PlacedShape> others, FrameSet all) const {
    const auto is_at_its_place = [&](int s) {
      const auto i = static_cast<std::size_t>(s);
      return i < others.size() && is_static(others[i], all) && are_placed_alike(all_shapes[i], others[i]);
    };
    return std::all_of(numbers.begin(), numbers.end(), is_at_its_place) &&
           std::ranges::count_if(others, [&](const PlacedShape& s) { return is_static(s, all); }) ==
               std::ssize(numbers);
  }

  std::span<const PlacedShape> all_shapes;
  std::vector<int> numbers;  // of those that are fixed
  MeshTrees meshes;
  Tree tree;
};

TwoLevel::TwoLevel(std::span<const PlacedShape> shapes, FrameSet all, BvhBuilder builder)
    : TwoLevel(std::make_shared<const Fixed>(shapes, all, builder), shapes, all, builder) {}

TwoLevel::TwoLevel(std::shared_ptr<const Fixed> fixed, std::span<const PlacedShape> shapes, FrameSet all,
                   BvhBuilder builder)
    : builder_(builder),
      fixed_(std::move(fixed)),
      shapes_(shapes),
      meshes_(builder, shapes, &fixed_->meshes),
      static_(fixed_->tree),
      dynamic_(shapes, numbers_of(shapes, [&](const PlacedShape& s) { return is_dynamic(s, all); }), all, builder,
               meshes_),
      margins_(std::max(static_.margins(), dynamic_.margins())) {
  if (dynamic_.empty() || all.count() == 1 || live_too_long(shapes, all)) return;
  of_frame_.resize(static_cast<std::size_t>(all.count()));
  parallel_for(all.count(), 1, [&](std::int64_t i) {
    const auto f = static_cast<Frame>(i);
    const auto there =
        numbers_of(shapes, [&](const PlacedShape& s) { return is_dynamic(s, all) && s.frames.contains(f); });
    of_frame_[static_cast<std::size_t>(i)] = {shapes, there, FrameSet::single(f), BvhBuilder::own, meshes_};
  });
}

TwoLevel::TwoLevel(const TwoLevel& sooner, std::span<const PlacedShape> shapes)
    : builder_(sooner.builder_),
      fixed_(sooner.fixed_),
      shapes_(shapes),
      meshes_(builder_, shapes, &sooner.meshes_),
      static_(fixed_->tree),
      dynamic_(sooner.dynamic_.refitted(shapes, meshes_)),
      margins_(std::max(static_.margins(), dynamic_.margins())),
      of_frame_(sooner.of_frame_.size()) {
  parallel_for(std::ssize(of_frame_), 1, [&](std::int64_t i) {
    const auto f = static_cast<std::size_t>(i);
    of_frame_[f] = sooner.of_frame_[f].refitted(shapes, meshes_);
  });
}

std::unique_ptr<Accel> TwoLevel::with(std::span<const PlacedShape> shapes, FrameSet all) const {
  if (!fixed_->is_in(shapes, all)) return nullptr;
  const bool fits = !dynamic_.has_crowds() && std::ranges::equal(shapes, shapes_, are_stored_alike);
  return std::unique_ptr<Accel>(fits ? new TwoLevel(*this, shapes) : new TwoLevel(fixed_, shapes, all, builder_));
}

std::size_t TwoLevel::memory() const {
  std::size_t bytes = fixed_->meshes.memory() + meshes_.memory() + static_.memory() + dynamic_.memory();
  for (const Tree& tree : of_frame_) bytes += tree.memory();
  return bytes;
}

}  // namespace dspm
