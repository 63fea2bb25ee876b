// ShapeMaker: meshes that deform while the shutter is open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/inner_files.h"
#include "dspm/shapes/deform.h"
#include "dspm/shapes/mesh_extent.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/world/objects/shape_maker.h"

namespace dspm {
namespace {

float velocity_scale(const ParamList& params, float usual) {
  const Param* const param = params.find(kVelocityScaleParam);
  const bool is_sound = param != nullptr && (param->type == ParamType::number || param->type == ParamType::integer) &&
                        numbers_of(*param).size() == 1;  // else the plugin reports it
  return is_sound ? numbers_of(*param).front() : usual;
}

bool has_velocities(const SourceShape& made) {
  const TriangleMesh* const mesh = made.shape->triangles();
  return mesh != nullptr && !mesh->data().velocities.empty();
}

bool are_alike(const MadeShapes& a, const MadeShapes& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SourceShape& x, const SourceShape& y) {
    return same_topology(*x.shape->triangles(), *y.shape->triangles());
  });
}

bool stays(const ParamList& params) {
  const std::string* const how = only_text(params.find(kBetweenParam));
  return how != nullptr && *how == "hold";
}

ParamList with_file(ParamList params, const std::string& name) {
  for (Param& param : params.params)
    if (param.name == "filename") param.values = std::vector{name};
  return params;
}

}  // namespace

/// Returns the mesh file; empty if there is none.
std::filesystem::path ShapeMaker::file_of(const ParamList& params) const {
  Diagnostics ignored;
  return ParamReader(params, subject_, use_.where, ignored, main_directory_).optional_file("filename", "");
}

/// Returns the parameters of a mesh that its file knows at any time; nullopt if it does not.
std::optional<ParamList> ShapeMaker::at_its_time(const ShapeState& state) const {
  if (state.delay == 0 || stays(state.params) || !is_moving_file(file_of(state.params))) return std::nullopt;
  ParamList params = with_file(state.params, name_later(*only_text(state.params.find("filename")), state.delay));
  std::erase_if(params.params, [](const Param& param) { return param.name == kExtentParam; });  // of whole frames
  return params;
}

MadeOfParams ShapeMaker::make(const ShapeState& state, Diagnostics& diagnostics) const {
  // Not kept: that time does not come again.
  if (const std::optional<ParamList> params = at_its_time(state)) return make_anew(*params, diagnostics);
  MadeOfParams made = make(state.params, diagnostics);
  const auto scale = static_cast<double>(velocity_scale(state.params, usual_velocity_scale_));
  made.has_velocities = scale != 0 && std::any_of(made.shapes.begin(), made.shapes.end(), has_velocities);
  if (state.delay == 0 || diagnostics.error_count() > 0) return made;
  if (made.has_velocities)
    move_by_velocities(state, scale, made, diagnostics);
  else if (!made.shapes.empty() && are_meshes(made.shapes))
    move_to_files(state, made, diagnostics);
  return made;
}

void ShapeMaker::move_by_velocities(const ShapeState& state, double scale, MadeOfParams& made,
                                    Diagnostics& diagnostics) const {
  const std::optional<Bounds3> extent = extent_in(state.params);
  for (SourceShape& each : made.shapes) try {
      if (!has_velocities(each)) continue;
      each.shape = std::make_shared<TriangleMesh>(moved(*each.shape->triangles(), time_ * scale));
      if (extent && !holds(*extent, each.shape->triangles()->vertices()))
        diagnostics.error(state.params.find(kExtentParam)->where, "by its velocities, the mesh goes beyond this box");
    } catch (const std::invalid_argument& fault) {
      diagnostics.error(use_.where, fmt::format("by its velocities, {}", fault.what()));
    }
  made.key.reset();
}

/// Goes from file to file as far as the delay leads, or until one is not there or is unlike the frame's own.
void ShapeMaker::move_to_files(const ShapeState& state, MadeOfParams& made, Diagnostics& diagnostics) const {
  if (state.files.empty() || stays(state.params)) return;
  const MadeShapes own = made.shapes;
  MadeShapes from = own, to = own;
  double left = std::abs(state.delay), t = 0;
  std::string at = *only_text(state.params.find("filename"));
  for (const std::string& file : state.files) {
    MadeShapes next = to;
    if (file != at) {
      const ParamList params = with_file(state.params, file);
      if (file_of(params).empty()) break;
      Diagnostics messages(diagnostics.lenient());
      next = make(params, messages).shapes;
      if (messages.error_count() > 0) return diagnostics.append(std::move(messages));
      if (!are_alike(own, next)) {
        made.unlike = UnlikeFiles{at, file};
        break;
      }
    }
    from = std::exchange(to, std::move(next)), at = file;
    t = std::min(left, 1.0), left -= t;
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (from[i].shape == own[i].shape && to[i].shape == own[i].shape) continue;
    made.shapes[i].shape = std::make_shared<TriangleMesh>(
        between(*own[i].shape->triangles(), *from[i].shape->triangles(), *to[i].shape->triangles(), t));
    made.key.reset();
  }
}

}  // namespace dspm
