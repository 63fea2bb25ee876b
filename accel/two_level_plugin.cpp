#include <algorithm>
#include <set>

#include "dspm/accel/crowd.h"
#include "dspm/accel/dynamic_shapes.h"
#include "dspm/accel/two_level.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"

namespace dspm {

std::size_t two_level_bytes(std::span<const PlacedShape> shapes, FrameSet all) {
  // Bytes per triangle: those of cathedrals, horses and landscapes are 60 to 85, and about 40 more for a while. Pieces
  // of hair take less than half of that.
  constexpr std::size_t kKept = 95, kBuilding = 45;
  std::set<const Shape*> placed_meshes;
  std::size_t still = 0, moving = 0, in_trees_of_frames = 0;
  for (const PlacedShape& shape : shapes) {
    if (has_own_tree(shape) && !placed_meshes.insert(shape.shape).second) continue;
    const auto count = static_cast<std::size_t>(shape.shape->primitive_count()) / (is_crowd(*shape.shape) ? 2 : 1);
    (is_dynamic(shape, all) ? moving : still) += count;
    if (is_dynamic(shape, all) && !shape.in_object_space())
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
