// Writes a document's scene: its materials, its tree of nodes, its variants; and what goes before if it is a whole
// scene.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/document.h"
#include "dspm/lang/gltf/material_uses.h"
#include "dspm/lang/gltf/names.h"
#include "dspm/lang/gltf/poses.h"
#include "dspm/lang/gltf/primitive.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/gltf/view.h"

namespace dspm::gltf {

class SceneWriter {
 public:
  SceneWriter(std::shared_ptr<const Document> document, std::string folder, const Settings& settings);

  Translation write();

 private:
  /// The animation, in the frames of the scene; closures that make meshes hold it.
  struct Motion {
    Animation animation;
    int frames = 1;
    double fps = 24;
    std::unique_ptr<const Poses> poses;
  };
  static std::shared_ptr<const Motion> motion_of(const Document& document, const Settings& settings);

  std::vector<std::size_t> roots() const;
  void visit(std::size_t node);

  void see(std::size_t node, std::size_t mesh);
  void see_deformed(std::size_t node, const Primitive& rest);
  void see_points(std::size_t node, const std::vector<Vec3>& points);
  void see_points(const std::vector<Vec3>& points, const Matrix4& place);
  bool stays(std::size_t node) const;
  std::vector<int> frames_to_see() const;
  std::size_t points_to_see(std::size_t frames) const;
  std::vector<Pose> instances_of(std::size_t node) const;

  void see_corners();
  void add_corners(std::size_t node, std::set<double>& corners) const;
  void write_node(std::size_t node, int depth);
  void write_content(std::size_t node, int depth);
  void write_keys(std::size_t node, int depth);
  void write_pose(const Pose& pose, int depth);
  std::vector<std::pair<double, Pose>> key_poses(std::size_t node) const;
  void write_mesh(std::size_t node, int depth);
  void write_skinned(std::size_t node, int depth);
  void write_instances(std::size_t node, int depth);
  bool is_still(std::size_t node) const;
  void write_shapes(std::size_t node, bool changes, int depth, const std::string& name);
  void write_light(std::size_t node, int depth);
  void line(int depth, const std::string& text) {
    world_ += std::string(2 * static_cast<std::size_t>(depth), ' ') + text + "\n";
  }

  std::string picture_name(std::size_t image);
  std::string mesh_file(std::size_t node, std::size_t primitive, bool changes);
  std::string extent_of(std::size_t node, const Value& primitive) const;
  bool changes_shape(std::size_t node) const;
  std::string world_name() const { return document_->path().stem().string() + ": world"; }
  std::string object_of(std::size_t mesh, std::size_t node);
  std::string header();
  std::optional<double> exposure();
  std::string surroundings(double strength);
  std::string camera(std::size_t node, double& aspect);
  void choose_camera();
  std::string name_of(std::size_t node, const char* instead) const;

  std::shared_ptr<const Document> document_;
  std::string folder_;
  const Settings settings_;
  std::shared_ptr<const Motion> motion_;
  Materials materials_;
  MaterialUses uses_;
  Translation result_;
  Names files_, objects_;
  std::map<std::size_t, std::string> pictures_, object_names_;
  std::map<std::size_t, int> mesh_uses_;  // nodes that place a mesh
  std::string world_, objects_text_;
  Subject subject_;
  std::map<std::size_t, std::vector<Vec3>> stiff_points_;  // of meshes that keep their shape
  std::vector<std::size_t> cameras_;                       // nodes
  std::optional<std::size_t> camera_node_;
  bool has_light_ = false;
  std::vector<bool> useful_;
  /// Corners of the ways of nodes between frames, and the frame after the last; frames count from 0.
  std::vector<double> corners_;
  std::unique_ptr<const Poses> at_corners_;
};

}  // namespace dspm::gltf
