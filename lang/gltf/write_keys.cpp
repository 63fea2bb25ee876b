// SceneWriter: the places of nodes, with keys for those that move.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dspm/base/math/transform.h"
#include "dspm/lang/gltf/scene_writer.h"

namespace dspm::gltf {
namespace {

using Part = std::pair<std::string, bool>;  // a transform, and whether it does nothing

std::string matrix_text(const std::array<double, 16>& columns) {
  std::string numbers;
  for (const double n : columns) numbers += fmt::format("{}{}", numbers.empty() ? "" : " ", n);
  return fmt::format("ConcatTransform [{}]", numbers);
}

std::array<double, 16> columns_of(const Matrix4& matrix) {
  std::array<double, 16> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = matrix.m[i % 4][i / 4];
  return columns;
}

std::vector<Part> parts_of(const Pose& pose, bool turns_by_matrix = false) {
  if (pose.matrix) {
    const std::array<double, 16> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    return {{matrix_text(*pose.matrix), *pose.matrix == identity}};
  }
  const auto turn = pose.turn();
  const auto& t = pose.translation;
  const auto& s = pose.scale;
  return {{fmt::format("Translate {} {} {}", t[0], t[1], t[2]), t == std::array<double, 3>{0, 0, 0}},
          {turns_by_matrix ? matrix_text(columns_of(Matrix4::rotate(turn[0], turn[1], turn[2], turn[3])))
                           : fmt::format("Rotate {} {} {} {}", turn[0], turn[1], turn[2], turn[3]),
           turn[0] == 0},
          {fmt::format("Scale {} {} {}", s[0], s[1], s[2]), s == std::array<double, 3>{1, 1, 1}}};
}

std::array<double, 4> quaternion_of(const std::array<double, 4>& turn) {
  const double half = turn[0] * static_cast<double>(kPi) / 360, length = std::hypot(turn[1], turn[2], turn[3]);
  const double sine = length > 0 ? std::sin(half) / length : 0;
  return {turn[1] * sine, turn[2] * sine, turn[3] * sine, std::cos(half)};
}

/// Returns whether the rotation halfway is that of the angle and the axis halfway.
bool turns_by_arguments(const Pose& a, const Pose& b) {
  constexpr double kLeeway = 1e-10;
  std::array<double, 4> turn = a.turn();
  const std::array<double, 4> other = b.turn(), from = quaternion_of(turn), to = quaternion_of(other);
  double cosine = 0;
  for (std::size_t c = 0; c < 4; ++c) cosine += from[c] * to[c];
  for (std::size_t c = 0; c < 4; ++c) turn[c] = 0.5 * (turn[c] + other[c]);
  const std::array<double, 4> halfway = quaternion_of(turn);
  double along = 0, length2 = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const double sum = from[c] + (cosine < 0 ? -to[c] : to[c]);
    along += sum * halfway[c], length2 += sum * sum;
  }
  return std::abs(along) > (1 - kLeeway) * std::sqrt(length2);
}

}  // namespace

void SceneWriter::write_pose(const Pose& pose, int depth) {
  for (const auto& [part, idle] : parts_of(pose))
    if (!idle) line(depth, part);
}

void SceneWriter::see_corners() {
  std::set<double> corners{static_cast<double>(motion_->frames)};
  for (std::size_t node = 0; node < useful_.size(); ++node)
    if (useful_[node] && motion_->poses->moves(node)) add_corners(node, corners);
  corners_.assign(corners.begin(), corners.end());
  std::vector<double> seconds = corners_;
  for (double& second : seconds) second /= motion_->fps;
  at_corners_ = std::make_unique<const Poses>(*document_, motion_->animation, seconds);
}

void SceneWriter::add_corners(std::size_t node, std::set<double>& corners) const {
  const std::string pointer = fmt::format("/nodes/{}/", node);
  for (const Channel& channel : motion_->animation.channels)
    if (channel.target().starts_with(pointer)) channel.add_corners(motion_->fps, motion_->frames, corners);
}

/// Returns the node's places by frames from 0 on: in each frame, in the one after the last, and at corners in between.
std::vector<std::pair<double, Pose>> SceneWriter::key_poses(std::size_t node) const {
  std::set<double> corners;
  add_corners(node, corners);
  for (int frame = 0; frame <= motion_->frames; ++frame) corners.insert(frame);
  std::vector<std::pair<double, Pose>> keys;
  for (const double frame : corners) {
    const auto known = std::lower_bound(corners_.begin(), corners_.end(), frame);
    if (frame < motion_->frames && frame == std::floor(frame))
      keys.emplace_back(frame, motion_->poses->at(node, static_cast<int>(frame)));
    else
      keys.emplace_back(frame, at_corners_->at(node, static_cast<int>(known - corners_.begin())));
  }
  return keys;
}

void SceneWriter::write_keys(std::size_t node, int depth) {
  if (!motion_->poses->moves(node)) return write_pose(motion_->poses->at(node, 0), depth);
  const std::vector<std::pair<double, Pose>> poses = key_poses(node);
  const bool by_matrix = std::adjacent_find(poses.begin(), poses.end(), [](const auto& a, const auto& b) {
                           return !turns_by_arguments(a.second, b.second);
                         }) != poses.end();
  std::vector<std::vector<Part>> keys;
  for (const auto& [frame, pose] : poses) keys.push_back(parts_of(pose, by_matrix));
  if (keys[keys.size() - 1] == keys[keys.size() - 2]) keys.pop_back();  // rests after the last frame
  const auto differ = [&](std::size_t a, std::size_t b) { return keys[a] != keys[b]; };
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && i + 1 < keys.size() && !differ(i, i - 1) && !differ(i, i + 1)) continue;
    std::string key = fmt::format("Keyframe {}", poses[i].first + 1);
    for (std::size_t part = 0; part < keys[i].size(); ++part)
      if (!std::all_of(keys.begin(), keys.end(), [&](const auto& k) { return k[part].second; }))
        key += " " + keys[i][part].first;
    line(depth, key);
  }
  line(depth, "KeyframeEnd");
}

}  // namespace dspm::gltf
