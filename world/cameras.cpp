#include "dspm/world/cameras.h"

#include "dspm/base/params/params.h"
#include "dspm/world/objects/in_frame.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/params_at.h"
#include "dspm/world/objects/placement_check.h"

namespace dspm {
namespace {

/// Inverts a matrix; make_cameras() has refused those that have no inverse.
Transform inverted(const Matrix4& camera_from_world) {
  return Transform(camera_from_world.inverse().value_or(Matrix4()));
}

struct State {
  const CameraUse* use;
  ParamList params;
  Matrix4 camera_from_world;
};

State state_at(const SceneDescription& description, FileFrame frame, Moment moment) {
  const CameraUse& use = camera_use(description, frame);
  return {&use, params_at(use.params, description.frames, moment), use.camera_from_world.at(moment)};
}

/// Returns null if there is no such camera; of one that has errors, the result does not count.
std::unique_ptr<Camera> make(const State& state, CameraContext context, Diagnostics& diagnostics) {
  const auto* plugin = camera_plugins().find(state.use->type, state.use->type_where, diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader reader(state.params, "camera \"" + state.use->type + "\"", state.use->where, diagnostics);
  context.to_world = inverted(state.camera_from_world);
  return plugin->make(reader, context);
}

}  // namespace

const CameraUse& camera_use(const SceneDescription& description, FileFrame frame) {
  static const CameraUse fallback{{"perspective", {}, {}, {}}, {}};
  const CameraUse* const use = description.camera_of(frame);
  return use != nullptr ? *use : fallback;
}

Transform camera_to_world(const SceneDescription& description, FileFrame frame) {
  return inverted(camera_use(description, frame).camera_from_world.at(description.frames.moment(frame)));
}

Timeline<std::shared_ptr<const Camera>> make_cameras(const SceneDescription& description, const CameraContext& film,
                                                     Diagnostics& diagnostics) {
  const auto states = Timeline<State>::of(
      description.frames.count(),
      [&](FileFrame f) -> std::optional<State> { return state_at(description, f, description.frames.moment(f)); },
      [](const State& a, const State& b) {
        return a.camera_from_world == b.camera_from_world && a.use->type == b.use->type &&
               (a.use == b.use && !a.use->params.is_keyed() ? true : a.params.same_values(b.params));
      },
      [](const State& state) { return Likeness().add(state.camera_from_world).add(state.params).number(); });
  Timeline<std::shared_ptr<const Camera>> cameras;
  cameras.state_of = states.state_of;
  const int errors = diagnostics.error_count();
  for (FileFrame f(0); f.index() < description.frames.count(); ++f) {
    const State& state = states.states[static_cast<std::size_t>(states.at(f))];
    if (is_sound(state.camera_from_world)) continue;
    report_singular("the camera", in_frame(description.frames, f), state.use->where, diagnostics);
    return cameras;
  }
  for (const State& state : states.states) {
    std::unique_ptr<Camera> camera = make(state, film, diagnostics);
    if (camera == nullptr) break;
    cameras.states.emplace_back(std::move(camera));
    if (diagnostics.error_count() > errors) break;
  }
  return cameras;
}

std::shared_ptr<const Camera> camera_at(const SceneDescription& description, FileFrame frame, Moment moment,
                                        const CameraContext& film) {
  const State state = state_at(description, frame, moment);
  if (!is_sound(state.camera_from_world)) return nullptr;
  Diagnostics diagnostics(true);
  std::shared_ptr<const Camera> camera = make(state, film, diagnostics);
  return diagnostics.error_count() > 0 ? nullptr : camera;
}

}  // namespace dspm
