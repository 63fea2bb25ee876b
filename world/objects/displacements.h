// "displacement" of meshes: the texture by which a shape moves, its states over the frames, and the shape that it
// makes.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/shapes/shape.h"
#include "dspm/world/objects/looks.h"
#include "dspm/world/objects/timeline.h"

namespace dspm {

/// One shape that a Shape directive made. Shapes may be shared with other scenes that have them; those are not changed.
struct SourceShape {
  std::shared_ptr<Shape> shape;
  std::optional<FileMaterial> material;
  bool repair = false;
  std::optional<Displacement> displacement;
};
using MadeShapes = std::vector<SourceShape>;
using Shapes = std::vector<std::shared_ptr<const Shape>>;

/// The geometry of a Shape directive over the frames of the file.
struct GeometryStates {
  Timeline<std::pair<int, int>> states;  // of the parameters and of the displacement
  std::vector<Shapes> shapes;            // by state: shared by all places
};

/// Takes the shapes that were made for each state of the parameters, and displaces those that ask for it.
GeometryStates displaced(const ShapeUse& use, const std::vector<int>& state_of_params, std::vector<MadeShapes> made,
                         const SceneDescription& description, Looks& looks, Diagnostics& diagnostics);

}  // namespace dspm
