#include "dspm/world/objects/shape_maker.h"

#include <algorithm>
#include <utility>

#include "dspm/shapes/shadow_catcher.h"
#include "dspm/shapes/shape_caustics.h"
#include "dspm/world/objects/param_key.h"
#include "dspm/world/objects/param_states.h"

namespace dspm {
namespace {

/// Moves the parameters of what was made to the directive's place.
void move_to(const SourceLocation& where, MadeShapes& made) {
  for (SourceShape& shape : made)
    if (shape.material)
      for (Param& param : shape.material->params.params) param.where = param.values_where = where;
}

}  // namespace

bool are_meshes(const MadeShapes& made) {
  return std::all_of(made.begin(), made.end(), [](const SourceShape& s) { return s.shape->triangles() != nullptr; });
}

ShapeMaker::ShapeMaker(const Plugin<MakeShape>& plugin, const ShapeUse& use, const SceneDescription& scene,
                       KeptGeometry* kept)
    : plugin_(plugin),
      use_(use),
      subject_(subject_of(use)),
      main_directory_(scene.main_directory()),
      time_(scene.frames.delay() / scene.fps.value_or(1)),
      usual_velocity_scale_(scene.dialect == Dialect::pbrt ? 0.f : 1.f),
      kept_(kept) {}

ContentKey ShapeMaker::key_of(const ParamList& params) const {
  ContentKey key(use_.type);
  key.add(main_directory_.string());
  add(key, params);
  return key;
}

MadeOfParams ShapeMaker::make(const ParamList& params, Diagnostics& diagnostics) const {
  if (kept_ == nullptr) return make_anew(params, diagnostics);
  const ContentKey key = key_of(params);
  if (std::optional<MadeShapes> known = kept_->find(key)) {
    ParamReader reader(params, subject_, use_.where, diagnostics, main_directory_);
    const Param* const file = params.find("filename");
    move_to(file != nullptr ? file->where : use_.where, *known);
    return {*std::move(known), read_shape_caustics(reader), read_shadow_catcher(reader), key};
  }
  const auto begin = KeptGeometry::Clock::now();
  const FilesReadHere files;
  MadeOfParams made = make_anew(params, diagnostics);
  const bool is_displaced = std::any_of(made.shapes.begin(), made.shapes.end(),
                                        [](const SourceShape& shape) { return shape.displacement.has_value(); });
  if (!diagnostics.all().empty() || is_displaced || !kept_->may_keep(files)) return made;
  if (are_meshes(made.shapes)) kept_->keep(key, made.shapes, files, begin);
  if (are_meshes(made.shapes) || (files.files() && files.files()->empty())) made.key = key;
  return made;
}

MadeOfParams ShapeMaker::make_anew(const ParamList& params, Diagnostics& diagnostics) const {
  ParamReader reader(params, subject_, use_.where, diagnostics, main_directory_);
  MadeOfParams result;
  result.caustics = read_shape_caustics(reader);
  result.is_catcher = read_shadow_catcher(reader);
  for (MadeShape& made : plugin_.make(reader))
    result.shapes.push_back(
        {std::move(made.shape), std::move(made.material), made.repair, std::move(made.displacement)});
  return result;
}

}  // namespace dspm
