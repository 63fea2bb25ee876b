#include "dspm/looking/serve/describe_run.h"

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/json.h"
#include "dspm/output/image_name.h"

namespace dspm {
namespace {

void write_axes(JsonWriter& json, const SceneDescription& scene) {
  json.key("axes").begin_array();
  for (const VariationAxis& axis : scene.axes) {
    json.begin_object();
    json.member("name", axis.name);
    json.key("variations").begin_array();
    for (const Variation& variation : axis.variations) json.value(variation.name);
    json.end_array();
    json.end_object();
  }
  json.end_array();
}

void write_vector(JsonWriter& json, const char* name, const Vec3& v) {
  json.key(name).begin_array();
  for (const float component : {v.x, v.y, v.z}) json.value(component);
  json.end_array();
}

/// Writes where the camera stands, and which ways forward and up are.
void write_camera(JsonWriter& json, const Matrix4& camera_from_world) {
  const std::optional<Matrix4> inverse = camera_from_world.inverse();
  if (!inverse) return;
  const Transform to_world(*inverse);
  write_vector(json, "eye", to_world.point(Vec3()));
  write_vector(json, "forward", to_world.vector({0, 0, 1}));
  write_vector(json, "up", to_world.vector({0, 1, 0}));
  json.member("mirrors", to_world.swaps_handedness() ? 1 : 0);
}

void write_frames(JsonWriter& json, const Job& job) {
  const FileFrames& frames = job.description->frames;
  json.key("frames").begin_array();
  for (const FileFrame frame : job.frames) {
    json.begin_object();
    json.member("label", frames.label(frame));
    json.member("moment", frames.moment(frame).number());
    json.member("variation", frames.variation(frame));
    json.key("choices").begin_array();
    for (std::size_t axis = 0; axis < job.description->axes.size(); ++axis) json.value(frames.choice(frame, axis));
    json.end_array();
    if (job.description->camera) write_camera(json, job.description->camera->camera_from_world.at(job.moment(frame)));
    json.end_object();
  }
  json.end_array();
}

void write_outputs(JsonWriter& json, std::span<const OutputInfo> outputs) {
  json.key("outputs").begin_array();
  for (const OutputInfo& output : outputs) {
    json.begin_object();
    json.member("name", output.name);
    json.member("sentence", output.sentence);
    json.member("is_id", output.is_id ? 1 : 0);
    json.member("is_radiance", output.is_radiance || output.name == kRadiance ? 1 : 0);
    json.key("channels").begin_array();
    for (const std::string& channel : output.channels) json.value(channel);
    json.end_array();
    json.key("names").begin_array();
    for (const std::string& name : output.names) {
      json.begin_object();
      json.member("name", name);
      json.member("id", id_of(name));
      json.end_object();
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
}

void write_texts(JsonWriter& json, const char* name, std::span<const std::string> texts) {
  json.key(name).begin_array();
  for (const std::string& text : texts) json.value(text);
  json.end_array();
}

std::vector<std::string> names_of_images(const Job& job) {
  std::vector<std::string> names;
  for (const FileFrame frame : job.frames)
    names.push_back(image_name(job.film.filename, job.numbered ? std::optional(job.moment(frame)) : std::nullopt,
                               job.variation(frame))
                        .string());
  return names;
}

}  // namespace

std::string describe_run(const Job& job, const Scene& scene, std::span<const OutputInfo> outputs,
                         const ViewSettings& view, int number, int halvings) {
  JsonWriter json;
  json.begin_object();
  json.member("run", number);
  json.member("scene", job.scene_file);
  json.member("integrator", job.integrator);
  json.member("width", job.settings.crop.width() << halvings);
  json.member("height", job.settings.crop.height() << halvings);
  json.member("fps", job.fps);
  json.member("numbered", job.numbered ? 1 : 0);
  write_vector(json, "center", scene.center);
  json.member("radius", scene.radius);
  write_axes(json, *job.description);
  write_frames(json, job);
  write_outputs(json, outputs);
  write_texts(json, "groups", scene.light_groups);
  write_texts(json, "images", names_of_images(job));
  json.key("view").begin_object();
  json.member("name", view.view.empty() || view.view.starts_with("ocio") ? "agx" : view.view);
  json.member("stops", view.stops);
  json.end_object();
  json.end_object();
  return json.text();
}

}  // namespace dspm
