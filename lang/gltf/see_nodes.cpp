// SceneWriter: where surfaces are over all frames, whichever of them are rendered.
#include <algorithm>

#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/scene_writer.h"

namespace dspm::gltf {
namespace {

constexpr int kMostFramesSeen = 2000;
constexpr std::size_t kMostPoints = 1 << 16;    // of a mesh
constexpr std::size_t kMostPlaces = 2'000'000;  // of points, over all meshes and frames
constexpr std::size_t kFewestPoints = 32;       // of a mesh in a frame, besides those of its outline

std::vector<Vec3> points_of(const Numbers& positions) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < positions.count; ++i)
    points.push_back({positions[i][0], positions[i][1], positions[i][2]});
  return points;
}

/// Returns the frames in which the node and what it hangs on are visible; if it rests, the first of them.
std::vector<int> visible_in(std::vector<int> frames, const Poses& poses, std::size_t node, bool rests) {
  std::erase_if(frames, [&](int frame) {
    for (std::optional<std::size_t> at = node; at; at = poses.parent(*at))
      if (!poses.at(*at, frame).visible) return true;
    return false;
  });
  if (rests && !frames.empty()) frames.erase(frames.begin() + 1, frames.end());
  return frames;
}

std::vector<Vec3> outline(const std::vector<Vec3>& points, std::size_t most) {
  std::vector<Vec3> chosen;
  for (const std::size_t i : outline_of(points, most)) chosen.push_back(points[i]);
  return chosen;
}

}  // namespace

/// Reads a mesh for the first time, so what is wrong with it is said before anything is rendered.
void SceneWriter::see(std::size_t node, std::size_t mesh) {
  const Document& document = *document_;
  const bool is_skinned = document["nodes"][node]["skin"].exists();
  const Value primitives = document["meshes"][mesh]["primitives"];
  const bool is_stiff = !is_skinned && primitives[0]["targets"].size() == 0;
  std::vector<Vec3>& stiff = stiff_points_[mesh];
  if (is_stiff && !stiff.empty()) return see_points(node, stiff);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    if (!has_surface(primitives[i])) continue;
    const Primitive rest = read_primitive(document, primitives[i]);
    if (!is_stiff) {
      see_deformed(node, rest);
      continue;
    }
    const std::vector<Vec3> points = outline(points_of(rest.positions), kMostPoints);
    stiff.insert(stiff.end(), points.begin(), points.end());
  }
  if (is_stiff) see_points(node, stiff);
}

void SceneWriter::see_deformed(std::size_t node, const Primitive& rest) {
  const Document& document = *document_;
  const Poses& poses = *motion_->poses;
  const auto skin = document["nodes"][node]["skin"].index(document["skins"].size());
  const std::vector<int> frames = visible_in(frames_to_see(), poses, node, stays(node) && !changes_shape(node));
  const Primitive some = vertices_of(rest, outline_of(points_of(rest.positions), points_to_see(frames.size())));
  for (const int frame : frames) {
    Primitive posed = frame == frames.front() ? rest : some;  // a fault of any vertex is found
    pose(posed, poses.at(node, frame).weights, skin ? poses.skin(document, *skin, frame) : std::vector<Matrix4>());
    see_points(points_of(posed.positions), skin ? Matrix4() : poses.world(node, frame));
  }
}

void SceneWriter::see_points(std::size_t node, const std::vector<Vec3>& points) {
  const std::vector<int> frames = visible_in(frames_to_see(), *motion_->poses, node, stays(node));
  std::vector<Matrix4> instances{Matrix4()};
  if ((*document_)["nodes"][node].extension("EXT_mesh_gpu_instancing").exists()) {
    instances.clear();
    for (const Pose& instance : instances_of(node)) instances.push_back(instance.transform());
  }
  const std::vector<Vec3> some = outline(points, points_to_see(frames.size() * instances.size()));
  for (const int frame : frames)
    for (const Matrix4& instance : instances) see_points(some, motion_->poses->world(node, frame) * instance);
}

void SceneWriter::see_points(const std::vector<Vec3>& points, const Matrix4& place) {
  const Transform to_world(Matrix4::scale(1, 1, -1) * place);
  std::vector<Vec3> placed;
  for (const Vec3& point : points) placed.push_back(to_world.point(point));
  subject_.add(placed);
}

/// Returns whether the node is at the same place of the world in all frames.
bool SceneWriter::stays(std::size_t node) const {
  for (std::optional<std::size_t> at = node; at; at = motion_->poses->parent(*at))
    if (motion_->poses->moves(*at)) return false;
  return true;
}

/// Returns all frames, or if they are very many some from the first to the last.
std::vector<int> SceneWriter::frames_to_see() const {
  const int count = std::min(motion_->frames, kMostFramesSeen);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(count == 1 ? 0 : static_cast<int>(std::int64_t{i} * (motion_->frames - 1) / (count - 1)));
  return frames;
}

/// Returns how many points of one mesh are looked at, at each of its places.
std::size_t SceneWriter::points_to_see(std::size_t places) const {
  const std::size_t meshes = std::max<std::size_t>((*document_)["meshes"].size(), 1);
  return std::max(kFewestPoints, kMostPlaces / (meshes * std::max<std::size_t>(places, 1)));
}

}  // namespace dspm::gltf
