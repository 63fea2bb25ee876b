// Makes the shapes of a Shape directive, or returns those that were made of the same parameters before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dspm/base/params/errors.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/shapes/shape.h"
#include "dspm/world/objects/content_key.h"
#include "dspm/world/objects/displacements.h"
#include "dspm/world/objects/kept_geometry.h"

namespace dspm {

struct MadeOfParams {
  MadeShapes shapes;
  bool caustics = true;           // see PlacedShape
  bool is_catcher = false;        // of shadows
  std::optional<ContentKey> key;  // nothing: it cannot be kept
};

class ShapeMaker {
 public:
  /// `kept` is null if nothing is kept.
  ShapeMaker(const Plugin<MakeShape>& plugin, const ShapeUse& use, std::filesystem::path main_directory,
             KeptGeometry* kept);

  /// Makes shapes; any thread may call it. Only what gave no message is known from before; what gave one is made again,
  /// and gives it again.
  MadeOfParams make(const ParamList& params, Diagnostics& diagnostics) const;

 private:
  MadeOfParams make_anew(const ParamList& params, Diagnostics& diagnostics) const;
  ContentKey key_of(const ParamList& params) const;

  const Plugin<MakeShape>& plugin_;
  const ShapeUse& use_;
  const std::string subject_;
  const std::filesystem::path main_directory_;
  KeptGeometry* const kept_;
};

/// Returns whether all of them are meshes, which absorb no others.
bool are_meshes(const MadeShapes& made);

}  // namespace dspm
