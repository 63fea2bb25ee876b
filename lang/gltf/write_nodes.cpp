// SceneWriter: the tree of nodes as blocks of the scene language. What moves is in Dynamic blocks with keys.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/lang/gltf/accessor.h"
#include "dspm/lang/gltf/extent.h"
#include "dspm/lang/gltf/lights.h"
#include "dspm/lang/gltf/primitive.h"
#include "dspm/lang/gltf/scene_writer.h"

namespace dspm::gltf {

bool SceneWriter::changes_shape(std::size_t node) const {
  const Value own = (*document_)["nodes"][node];
  if (const auto skin = own["skin"].index((*document_)["skins"].size()))
    return !motion_->poses->skin_rests(*document_, *skin) || motion_->poses->changes_weights(node);
  return motion_->poses->changes_weights(node);
}

void SceneWriter::write_node(std::size_t node, int depth) {
  if (!useful_[node]) return;
  const Poses& poses = *motion_->poses;
  const std::string name = in_quotes(name_of(node, "node"));
  if (poses.changes_visibility(node)) {
    for (int from = 0; from < poses.frames(); ++from) {
      if (!poses.at(node, from).visible) continue;
      int to = from;
      while (to + 1 < poses.frames() && poses.at(node, to + 1).visible) ++to;
      line(depth, fmt::format("DynamicBegin {} \"integer frames\" [{} {}]", name, from + 1, to + 1));
      write_keys(node, depth + 1), write_content(node, depth + 1);
      line(depth, "DynamicEnd");
      from = to;
    }
    return;
  }
  const bool is_dynamic = poses.moves(node);
  line(depth, is_dynamic ? fmt::format("DynamicBegin {}", name)
                         : fmt::format("AttributeBegin  # {}", name.substr(1, name.size() - 2)));
  write_keys(node, depth + 1), write_content(node, depth + 1);
  line(depth, is_dynamic ? "DynamicEnd" : "AttributeEnd");
}

void SceneWriter::write_content(std::size_t node, int depth) {
  const Value own = (*document_)["nodes"][node];
  write_light(node, depth);
  if (own["mesh"].exists()) {
    if (own["skin"].exists())
      write_skinned(node, depth);
    else if (own.extension("EXT_mesh_gpu_instancing").exists())
      write_instances(node, depth);
    else
      write_mesh(node, depth);
  }
  for (std::size_t i = 0; i < own["children"].size(); ++i) write_node(own["children"][i].count(0), depth);
}

void SceneWriter::write_mesh(std::size_t node, int depth) {
  const std::size_t mesh = (*document_)["nodes"][node]["mesh"].count(0);
  const Value first = (*document_)["meshes"][mesh]["primitives"][0];
  const bool changes = changes_shape(node);
  if (mesh_uses_[mesh] > 1 && !changes && first["targets"].size() == 0)
    return line(depth, fmt::format("ObjectInstance {}", in_quotes(object_of(mesh, node))));
  if (changes) line(depth, fmt::format("DynamicBegin {}", in_quotes(name_of(node, "mesh") + " in motion")));
  write_shapes(node, changes, depth + (changes ? 1 : 0),
               is_still(node) ? (*document_)["nodes"][node]["name"].text("") : "");
  if (changes) line(depth, "DynamicEnd");
}

/// Writes a skinned mesh, which its joints place in the world, wherever its node is.
void SceneWriter::write_skinned(std::size_t node, int depth) {
  const bool changes = changes_shape(node);
  const std::string name = in_quotes(name_of(node, "skin") + " in motion");
  line(depth, changes ? fmt::format("DynamicBegin {}", name) : "AttributeBegin");
  line(depth + 1, "CoordSysTransform " + in_quotes(world_name()));
  write_shapes(node, changes, depth + 1, is_still(node) ? (*document_)["nodes"][node]["name"].text("") : "");
  line(depth, changes ? "DynamicEnd" : "AttributeEnd");
}

/// Returns the node's instances. [EXT_mesh_gpu_instancing]
std::vector<Pose> SceneWriter::instances_of(std::size_t node) const {
  const Value own = (*document_)["nodes"][node];
  const Value attributes = own.extension("EXT_mesh_gpu_instancing")["attributes"];
  const auto read = [&](const char* name) {
    const auto accessor = attributes[name].index((*document_)["accessors"].size());
    return accessor ? numbers_of(*document_, *accessor) : Numbers();
  };
  const Numbers translations = read("TRANSLATION"), rotations = read("ROTATION"), scales = read("SCALE");
  const std::size_t count = std::max({translations.count, rotations.count, scales.count});
  for (const auto& [numbers, width] : {std::pair{&translations, 3u}, std::pair{&rotations, 4u}, std::pair{&scales, 3u}})
    if (numbers->count > 0 && (numbers->count != count || numbers->width != width))
      attributes.fail("its accessors do not fit one another");
  std::vector<Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    Pose& pose = poses[i];
    if (translations.count > 0) std::copy_n(translations[i], 3, pose.translation.begin());
    if (rotations.count > 0) std::copy_n(rotations[i], 4, pose.rotation.begin());
    if (scales.count > 0) std::copy_n(scales[i], 3, pose.scale.begin());
    for (double& scale : pose.scale) scale = with_inverse(scale);
  }
  return poses;
}

void SceneWriter::write_instances(std::size_t node, int depth) {
  const std::string object = object_of((*document_)["nodes"][node]["mesh"].count(0), node);
  for (const Pose& pose : instances_of(node)) {
    line(depth, "AttributeBegin");
    write_pose(pose, depth + 1);
    line(depth + 1, fmt::format("ObjectInstance {}", in_quotes(object)));
    line(depth, "AttributeEnd");
  }
}

std::string SceneWriter::object_of(std::size_t mesh, std::size_t node) {
  std::string& name = object_names_[mesh];
  if (!name.empty()) return name;
  const std::string prefix = settings_.around ? document_->path().stem().string() + ": " : "";
  name = prefix + objects_.add((*document_)["meshes"][mesh]["name"].text(""), fmt::format("mesh {}", mesh));
  std::swap(world_, objects_text_);
  if (!settings_.is_defined) {
    line(1, fmt::format("ObjectBegin {}", in_quotes(name)));
    write_shapes(node, false, 2, "");
    line(1, "ObjectEnd");
  }
  std::swap(world_, objects_text_);
  return name;
}

/// Returns whether the node is outside of Dynamic blocks, whose names are those of what is in them.
bool SceneWriter::is_still(std::size_t node) const {
  if (changes_shape(node) || !stays(node)) return false;
  for (std::optional<std::size_t> at = node; at; at = motion_->poses->parent(*at))
    if (motion_->poses->changes_visibility(*at)) return false;
  return true;
}

/// Writes shapes. `name` is that of what they are parts of; if it is empty, the scene gives it.
void SceneWriter::write_shapes(std::size_t node, bool changes, int depth, const std::string& name) {
  const std::string own = name.empty() ? "" : " \"string name\" " + in_quotes(name);
  const std::size_t mesh = (*document_)["nodes"][node]["mesh"].count(0);
  const Value primitives = (*document_)["meshes"][mesh]["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    if (!has_surface(primitives[i])) continue;
    line(depth, fmt::format("NamedMaterial {}", in_quotes(uses_.name_of(primitives[i]))));
    const std::string medium = uses_.medium_of(primitives[i]);
    if (!medium.empty()) {
      line(depth, "AttributeBegin");
      line(depth, fmt::format("MediumInterface {} \"\"", in_quotes(medium)));
    }
    line(depth, fmt::format("Shape \"plymesh\" \"string filename\" {}{}{}", in_quotes(mesh_file(node, i, changes)), own,
                            changes ? extent_of(node, primitives[i]) : ""));
    if (!medium.empty()) line(depth, "AttributeEnd");
  }
}

/// Returns the parameter for where a mesh is in all frames, by which those of frames that are not rendered are not made.
std::string SceneWriter::extent_of(std::size_t node, const Value& primitive) const {
  const Document& document = *document_;
  const PosedBoxes boxes(read_primitive(document, primitive));
  const auto skin = document["nodes"][node]["skin"].index(document["skins"].size());
  Bounds3 all;
  for (int frame = 0; frame < motion_->frames; ++frame)
    all.add(boxes.posed(motion_->poses->at(node, frame).weights,
                        skin ? motion_->poses->skin(document, *skin, frame) : std::vector<Matrix4>()));
  return fmt::format(" \"point3 extent\" [{} {} {}  {} {} {}]", all.low.x, all.low.y, all.low.z, all.high.x, all.high.y,
                     all.high.z);
}

/// Returns the name of a mesh's file, with %04d for the frame's number if it changes.
std::string SceneWriter::mesh_file(std::size_t node, std::size_t primitive, bool changes) {
  const Value own = (*document_)["nodes"][node];
  const std::size_t mesh = own["mesh"].count(0);
  const std::size_t primitives = (*document_)["meshes"][mesh]["primitives"].size();
  const std::string called = (*document_)["meshes"][mesh]["name"].text("");
  const std::string stem = for_file(called.empty() ? name_of(node, "mesh") : called);
  const std::string name =
      folder_ + "/" + files_.add(primitives > 1 ? fmt::format("{}-{}", stem, primitive + 1) : stem, "mesh");
  const auto offer = [&](const std::string& file, int frame) {
    const auto at = [document = document_, node, mesh, primitive](const Poses& poses, int number) {
      const Document& d = *document;
      Primitive posed = read_primitive(d, d["meshes"][mesh]["primitives"][primitive]);
      const auto skin = d["nodes"][node]["skin"].index(d["skins"].size());
      pose(posed, poses.at(node, number).weights, skin ? poses.skin(d, *skin, number) : std::vector<Matrix4>());
      return ply_of(posed);
    };
    result_.files[file] = [at, motion = motion_, frame] { return at(*motion->poses, frame); };
    if (!changes) return;
    result_.files_later[file] = [at, document = document_, motion = motion_, frame](double frames) {
      return at(Poses(*document, motion->animation, {(frame + frames) / motion->fps}), 0);
    };
  };
  if (!changes) return offer(name + ".ply", 0), name + ".ply";
  for (int frame = 0; frame < motion_->frames; ++frame) offer(fmt::format("{}.{:04}.ply", name, frame + 1), frame);
  return name + ".%04d.ply";
}

void SceneWriter::write_light(std::size_t node, int depth) {
  const Value use = (*document_)["nodes"][node].extension("KHR_lights_punctual")["light"];
  if (!use.exists()) return;
  const std::size_t light = use.required_index(document_->root().extension("KHR_lights_punctual")["lights"].size());
  std::vector<Statement> moments;
  Json json = document_->json();
  const bool changes = !motion_->animation.channels.empty();
  for (int frame = 0; frame < (changes ? motion_->frames : 1); ++frame) {
    if (changes) set_moment(json, motion_->animation, frame / motion_->fps);
    moments.push_back(light_of(Value(&json, "").extension("KHR_lights_punctual")["lights"][light]));
  }
  line(depth, text_of(keyed(moments)));
}

}  // namespace dspm::gltf
