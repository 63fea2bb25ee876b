// The source that Geometry makes of a Shape directive before it places it.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/shapes/shape.h"
#include "dspm/world/objects/content_key.h"
#include "dspm/world/objects/displacements.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/shape_maker.h"

namespace dspm {

/// One Shape directive: its geometry in its own space, state by state, and the materials of what was made.
struct Geometry::Source {
  Timeline<ShapeState> params;
  std::vector<MadeShapes> made;     // by state of `params`
  std::vector<int> materials;       // by index of what was made
  std::vector<EmissionUse> lights;  // likewise
  std::vector<int> alphas;          // likewise, see WorldShape
  bool caustics = true;             // see PlacedShape
  bool is_catcher = false;          // of shadows
  bool has_velocities = false;
  std::optional<UnlikeFiles> unlike;  // of any state
  GeometryStates geometry;
  // By the instances' dynamic block: objects that do not move differ in nothing but their matrix.
  std::map<int, std::shared_ptr<const Placement>> unmoved;
  std::vector<ContentKey> keys;  // of `made`; empty: it is not kept
  // With an extent, boxes are made, and the first mesh to be checked.
  bool has_extent = false;
  MadeShapes first;
  std::map<int, std::size_t> unread;  // by state of `geometry`: which of Geometry::unread_

  /// Takes over the shape of the next directive, which is alike, if both are one shape in one state and it allows that.
  bool absorb(Source& next) {
    const auto is_one = [](const Source& s) { return s.made.size() == 1 && s.made.front().size() == 1; };
    if (!is_one(*this) || !is_one(next) || caustics != next.caustics || is_catcher != next.is_catcher ||
        !made.front().front().shape->absorb(*next.made.front().front().shape))
      return false;
    if (next.keys.empty()) keys.clear();
    if (!keys.empty()) keys.front().add_bytes_of(next.keys.front());
    return true;
  }
};

}  // namespace dspm
