// Geometry: sequences whose meshes lie within an extent are read only in frames that need them. What sampling derives
// from all frames is derived from the extent, so it does not depend on the frames that are rendered.
#include <algorithm>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/mesh_extent.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/geometry_source.h"
#include "dspm/world/objects/moved_mesh.h"
#include "dspm/world/objects/same_in_all_frames.h"
#include "dspm/world/objects/shape_maker.h"

namespace dspm {
namespace {

/// Returns whether it is one mesh that stays as it was read.
bool is_plain(const MadeShapes& made) {
  return made.size() == 1 && made.front().shape->triangles() != nullptr && !made.front().repair &&
         !made.front().displacement;
}

}  // namespace

/// Makes boxes, if the directive is a sequence with an extent. The first mesh is read whatever is rendered, to be
/// checked.
void Geometry::take_extent(const ShapeUse& use, Source& source, Diagnostics& diagnostics) const {
  expect_same_in_all_frames(use, kExtentParam, diagnostics);
  const std::optional<Bounds3> extent = use.type == "plymesh" ? extent_in(use.params) : std::nullopt;
  const std::vector<ShapeState>& states = source.params.states;
  if (!extent || states.size() < 2 || diagnostics.error_count() > 0) return;
  const ShapeMaker maker = maker_of(use);
  Diagnostics messages(diagnostics.lenient());
  MadeOfParams made = maker.make(states.front(), messages);
  if (messages.error_count() > 0 || !is_plain(made.shapes)) return;
  diagnostics.append(std::move(messages));
  source.caustics = made.caustics, source.is_catcher = made.is_catcher;
  source.first = std::move(made.shapes), source.has_extent = true;
  SourceShape box;
  box.shape = std::make_shared<TriangleMesh>(mesh_of(*extent));
  source.made.assign(states.size(), {box});
}

void Geometry::read(std::span<const FileFrame> frames) {
  std::vector<const Unread*> wanted;
  for (const Unread& mesh : unread_)
    if (is_wanted(mesh, frames)) wanted.push_back(&mesh);
  std::vector<Diagnostics> messages(wanted.size(), Diagnostics(diagnostics_.lenient()));
  std::vector<MadeOfParams> made(wanted.size());
  parallel_for(static_cast<std::int64_t>(wanted.size()), 1, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    const ShapeUse& use = *wanted[at]->use;
    const ShapeMaker maker = maker_of(use);
    made[at] = maker.make(wanted[at]->state, messages[at]);
  });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const bool is_sound = messages[i].error_count() == 0;
    diagnostics_.append(std::move(messages[i]));
    note_unlike(*wanted[i]->use, made[i].unlike);
    if (is_sound) put(*wanted[i], std::move(made[i].shapes));
  }
}

bool Geometry::is_wanted(const Unread& mesh, std::span<const FileFrame> frames) const {
  return std::any_of(mesh.uses.begin(), mesh.uses.end(), [&](const Unread::Use& use) {
    const WorldShape& shape = shapes_[use.shape];
    return shape.is_unread && std::any_of(frames.begin(), frames.end(), [&](FileFrame f) {
             return shape.present.contains(f) || shape.only_parts.contains(f);
           });
  });
}

/// Puts a mesh where its box was. A file without faces is a frame without the shape.
void Geometry::put(const Unread& mesh, MadeShapes made) {
  for (const Unread::Use& use : mesh.uses) {
    WorldShape& shape = shapes_[use.shape];
    shape.is_unread = false, shape.nowhere = shape.nowhere || made.empty();
    if (made.empty()) continue;
    made.front().shape->settle();
    shape.shape = made.front().shape;
    if (!use.moved_by.is_identity()) shape.shape = moved_to(use.moved_by, shape.shape, kept_);
    shape.placed.shape = shape.shape.get();
  }
}

}  // namespace dspm
