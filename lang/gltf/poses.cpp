#include "dspm/lang/gltf/poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/accessor.h"

namespace dspm::gltf {
namespace {

constexpr std::size_t kMostDeep = 200;  // blocks of the language nest

Pose pose_of(const Document& document, const Value& node) {
  Pose pose;
  pose.translation = node["translation"].numbers(pose.translation);
  pose.rotation = node["rotation"].numbers(pose.rotation);
  pose.scale = node["scale"].numbers(pose.scale);
  if (node["matrix"].exists()) pose.matrix = node["matrix"].numbers(std::array<double, 16>{});
  pose.visible = node.extension("KHR_node_visibility")["visible"].flag(true);
  pose.weights = node["weights"].numbers();
  if (pose.weights.empty())
    if (const auto mesh = node["mesh"].index(document["meshes"].size()))
      pose.weights = document["meshes"][*mesh]["weights"].numbers();
  return pose;
}

void expect_transform(const std::array<double, 16>& columns, const Value& node) {
  const Matrix4 matrix = Matrix4::from_columns(columns);
  const char* const fault = !matrix.is_affine() ? "is not affine: its last row is not 0 0 0 1"
                            : !matrix.inverse() ? "is singular: it squeezes the node flat, or into a point"
                                                : nullptr;
  if (fault != nullptr) node.fail(fmt::format("the matrix of node \"{}\" {}", node["name"].text(""), fault));
}

/// Returns the nodes that some channel sets, and those whose meshes' weights are set.
std::set<std::size_t> animated_nodes(const Document& document, const Animation& animation) {
  std::set<std::size_t> nodes;
  const Value all = document["nodes"];
  for (const Channel& channel : animation.channels) {
    const std::string& target = channel.target();
    const bool of_node = target.starts_with("/nodes/"), of_mesh = target.starts_with("/meshes/");
    if (!of_node && !of_mesh) continue;
    const auto index = static_cast<std::size_t>(std::strtoul(target.c_str() + (of_node ? 7 : 8), nullptr, 10));
    if (of_node && index < all.size()) nodes.insert(index);
    for (std::size_t node = 0; of_mesh && node < all.size(); ++node)
      if (all[node]["mesh"].exists() && all[node]["mesh"].count(0) == index) nodes.insert(node);
  }
  return nodes;
}

std::vector<double> times_of(int frames, double fps) {
  std::vector<double> times;
  for (int frame = 0; frame < frames; ++frame) times.push_back(frame / fps);
  return times;
}

template <class Differ>
bool changes(const std::vector<Pose>& poses, Differ&& differ) {
  return std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) { return differ(pose, poses.front()); });
}

}  // namespace

std::array<double, 4> Pose::turn() const {
  const double length = std::hypot(rotation[0], rotation[1], rotation[2]);
  if (!(length > 1e-12)) return {0, 0, 1, 0};
  return {2 * std::atan2(length, rotation[3]) * 180 / static_cast<double>(kPi), rotation[0] / length,
          rotation[1] / length, rotation[2] / length};
}

Matrix4 Pose::transform() const {
  if (matrix) return Matrix4::from_columns(*matrix);
  const std::array<double, 4> r = turn();
  return Matrix4::translate(translation[0], translation[1], translation[2]) * Matrix4::rotate(r[0], r[1], r[2], r[3]) *
         Matrix4::scale(scale[0], scale[1], scale[2]);
}

Poses::Poses(const Document& document, const Animation& animation, int frames, double fps)
    : Poses(document, animation, times_of(frames, fps)) {}

Poses::Poses(const Document& document, const Animation& animation, const std::vector<double>& times)
    : frames_(static_cast<int>(times.size())) {
  const Value nodes = document["nodes"];
  parents_.resize(nodes.size()), poses_.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    poses_[i] = {pose_of(document, nodes[i])};
    const Value children = nodes[i]["children"];
    for (std::size_t j = 0; j < children.size(); ++j) {
      const std::size_t child = children[j].required_index(nodes.size());
      if (parents_[child])
        children[j].fail(fmt::format("node {} is already the child of node {}", child, *parents_[child]));
      parents_[child] = i;
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::size_t depth = 0;
    for (std::optional<std::size_t> up = parents_[i]; up; up = parents_[*up])
      if (++depth > kMostDeep) nodes[i].fail("its parents form a ring, or are more than 200");
  }
  const std::set<std::size_t> animated = animated_nodes(document, animation);
  Json json;  // of the document, what poses are read from
  for (const char* const part : {"nodes", "meshes"})
    if (document[part].exists()) json[part] = document[part].json();
  for (const std::size_t node : animated) poses_[node].clear();
  for (const double time : times) {
    if (animated.empty()) break;
    set_moment(json, animation, time);
    for (const std::size_t node : animated)
      poses_[node].push_back(pose_of(document, {&json["nodes"][node], fmt::format("nodes/{}", node)}));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (Pose& pose : poses_[i]) {
      for (double& scale : pose.scale) scale = with_inverse(scale);
      if (pose.matrix) expect_transform(*pose.matrix, nodes[i]);
    }
}

const Pose& Poses::at(std::size_t node, int frame) const {
  const std::vector<Pose>& poses = poses_[node];
  return poses[std::min(static_cast<std::size_t>(frame), poses.size() - 1)];
}

bool Poses::moves(std::size_t node) const {
  return changes(poses_[node], [](const Pose& a, const Pose& b) { return !a.is_at_place_of(b); });
}
bool Poses::changes_weights(std::size_t node) const {
  return changes(poses_[node], [](const Pose& a, const Pose& b) { return a.weights != b.weights; });
}
bool Poses::changes_visibility(std::size_t node) const {
  return changes(poses_[node], [](const Pose& a, const Pose& b) { return a.visible != b.visible; });
}

Matrix4 Poses::world(std::size_t node, int frame) const {
  Matrix4 world = at(node, frame).transform();
  for (std::optional<std::size_t> up = parents_[node]; up; up = parents_[*up])
    world = at(*up, frame).transform() * world;
  return world;
}

std::vector<Matrix4> Poses::skin(const Document& document, std::size_t index, int frame) const {
  const Value skin = document["skins"][index], joints = skin["joints"];
  Numbers inverses;
  if (const auto accessor = skin["inverseBindMatrices"].index(document["accessors"].size()))
    inverses = numbers_of(document, *accessor);
  if (inverses.count > 0 && (inverses.width != 16 || inverses.count < joints.size()))
    skin["inverseBindMatrices"].fail("a matrix for each joint is expected");
  std::vector<Matrix4> matrices;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Matrix4 bind;
    if (inverses.count > 0) {
      std::array<double, 16> columns{};
      std::copy(inverses[i], inverses[i] + 16, columns.begin());
      bind = Matrix4::from_columns(columns);
    }
    matrices.push_back(world(joints[i].required_index(poses_.size()), frame) * bind);
  }
  return matrices;
}

bool Poses::skin_rests(const Document& document, std::size_t index) const {
  const Value joints = document["skins"][index]["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::optional<std::size_t> node = joints[i].required_index(poses_.size()); node; node = parents_[*node])
      if (moves(*node)) return false;
  return true;
}

int frames_of(double duration, double fps, int most) {
  const double frames = std::floor(duration * fps + 1e-3) + 1;
  if (!(frames <= most))
    throw std::runtime_error(
        fmt::format("its animation of {} seconds has {} frames, and at most {} are rendered", duration, frames, most));
  return std::max(1, static_cast<int>(frames));
}

}  // namespace dspm::gltf
