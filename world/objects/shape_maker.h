// Makes the shapes of a Shape directive, or returns those that were made of the same parameters before. While the shutter
// is open, it deforms them.
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
#include "dspm/world/objects/shape_state.h"

namespace dspm {

/// Two files of a sequence between which a shape cannot deform: their vertices or faces differ.
struct UnlikeFiles {
  std::string own, other;
};

struct MadeOfParams {
  MadeShapes shapes;
  bool caustics = true;           // see PlacedShape
  bool is_catcher = false;        // of shadows
  std::optional<ContentKey> key;  // nothing: it cannot be kept
  bool has_velocities = false;    // by which it moves while the shutter is open
  std::optional<UnlikeFiles> unlike = std::nullopt;
};

class ShapeMaker {
 public:
  /// `kept` is null if nothing is kept.
  ShapeMaker(const Plugin<MakeShape>& plugin, const ShapeUse& use, const SceneDescription& scene, KeptGeometry* kept);

  /// Makes shapes; any thread may call it. Only what gave no message is known from before; what gave one is made again,
  /// and gives it again.
  MadeOfParams make(const ParamList& params, Diagnostics& diagnostics) const;
  /// Makes shapes as they are in that state: meshes move by the velocities of their vertices, or else on the way from
  /// file to file, as far as these have the same topology. Files that change with time are taken at that time.
  MadeOfParams make(const ShapeState& state, Diagnostics& diagnostics) const;

 private:
  MadeOfParams make_anew(const ParamList& params, Diagnostics& diagnostics) const;
  ContentKey key_of(const ParamList& params) const;
  std::optional<ParamList> at_its_time(const ShapeState& state) const;
  std::filesystem::path file_of(const ParamList& params) const;
  void move_by_velocities(const ShapeState& state, double scale, MadeOfParams& made, Diagnostics& diagnostics) const;
  void move_to_files(const ShapeState& state, MadeOfParams& made, Diagnostics& diagnostics) const;

  const Plugin<MakeShape>& plugin_;
  const ShapeUse& use_;
  const std::string subject_;
  const std::filesystem::path main_directory_;
  const double time_;  // that the shutter has been open in this scene: in seconds if it has them, else in frames
  const float usual_velocity_scale_;
  KeptGeometry* const kept_;
};

/// Returns whether all of them are meshes, which absorb no others.
bool are_meshes(const MadeShapes& made);

}  // namespace dspm
