#include "dspm/world/overlap_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/world/objects/in_frame.h"
#include "dspm/world/objects/param_states.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr std::size_t kMostWarnings = 5;

std::string named(const WorldShape& shape, const Looks& looks) {
  return fmt::format("{} with {}", subject_of(*shape.use), looks.name_of(shape.placed.material));
}
std::string place_of(const SourceLocation& where) {
  return where.file == nullptr ? std::string() : fmt::format(" ({}:{})", where.file->name, where.line);
}

/// Returns the state of a material in a frame of the scene.
const Material* state_of(const Scene& scene, int material, Frame frame) {
  const Material* found = nullptr;
  scene.materials[static_cast<std::size_t>(material)].for_each(
      FrameSet::single(frame), [&](FrameSet, const Material& state) { found = &state; });
  return found;
}

}  // namespace

void warn_of(const std::vector<Overlap>& overlaps, const Scene& bodies, const std::vector<const WorldShape*>& shapes,
             const Looks& looks, const FileFrames& frames, Diagnostics& diagnostics) {
  const auto shape = [&](int index) -> const WorldShape& { return *shapes[static_cast<std::size_t>(index)]; };
  constexpr const ShapeUse* none = nullptr;
  // Bodies may consist of several shapes: one warning for two materials, or for two directives of one material.
  const auto subjects_of = [&](const Overlap& overlap) {
    const WorldShape &first = shape(overlap.entered_first), &second = shape(overlap.entered_second);
    const auto materials = std::minmax(first.placed.material, second.placed.material);
    const auto uses = std::minmax(first.use, second.use);
    return materials.first == materials.second ? std::tuple(materials.first, materials.second, uses.first, uses.second)
                                               : std::tuple(materials.first, materials.second, none, none);
  };
  std::map<std::tuple<int, int, const ShapeUse*, const ShapeUse*>, const Overlap*> deepest;
  for (const Overlap& overlap : overlaps) {
    const Overlap*& known = deepest[subjects_of(overlap)];
    if (known == nullptr || overlap.depth > known->depth) known = &overlap;
  }
  std::vector<const Overlap*> told;
  for (const auto& [subjects, overlap] : deepest) told.push_back(overlap);
  std::stable_sort(told.begin(), told.end(), [](const Overlap* a, const Overlap* b) {
    return std::minmax(a->entered_first, a->entered_second) < std::minmax(b->entered_first, b->entered_second);
  });
  for (std::size_t i = 0; i < std::min(told.size(), kMostWarnings); ++i) {
    const auto [a, b] = std::minmax(told[i]->entered_first, told[i]->entered_second);
    const WorldShape &first = shape(a), &second = shape(b);
    const Frame frame = told[i]->frames.lowest();
    const std::string when =
        told[i]->frames == bodies.frames() ? "" : in_frame(frames, bodies.file_frames[static_cast<std::size_t>(frame)]);
    const Material &of_first = *state_of(bodies, first.placed.material, frame),
                   &of_second = *state_of(bodies, second.placed.material, frame);
    const Vec3& p = told[i]->place;
    const std::string what = fmt::format("{} overlaps {}{} near {:.4g} {:.4g} {:.4g}{}", named(second, looks),
                                         named(first, looks), place_of(first.use->where), p.x, p.y, p.z, when);
    if (of_first.priority() == of_second.priority())
      diagnostics.warning(
          second.use->where,
          fmt::format("{}; both have priority {}, so which of them is there is not known", what, of_first.priority()),
          "give one of the materials a higher \"integer priority\": it is there where they overlap");
    else
      diagnostics.warning(second.use->where,
                          fmt::format("{}; the one that scatters light inside has the lower priority, so light that "
                                      "enters it through the other one is not scattered",
                                      what),
                          "give it the higher \"integer priority\"");
  }
  if (told.size() > kMostWarnings)
    diagnostics.warning({}, fmt::format("{} more pairs of bodies overlap in this way", told.size() - kMostWarnings));
}

}  // namespace dspm
