#include "dspm/integrators/photons/medium_photons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dspm/base/math/z_curve.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/parallel_sort.h"
#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {
void MediumPhotons::build(const std::vector<PhotonTrace>& traces) {
  std::map<std::pair<int, std::uint64_t>, std::vector<Placed>> alike;  // by medium and frames
  count_ = 0;
  for (const PhotonTrace& trace : traces)
    for (const MediumPhoton& photon : trace.in_media)
      alike[{photon.medium, photon.frames.bits()}].push_back(
          {&photon, trace.strands.of(photon.strands), static_cast<std::uint32_t>(count_++)});
  trees_.clear();
  Tree mixed{{}, kMixed, {}};
  for (auto& [key, photons] : alike) {
    const FrameSet frames(key.second);
    if (photons.size() >= kMany) {
      trees_.push_back({frames, key.first, std::move(photons)});
      continue;
    }
    mixed.frames |= frames;
    mixed.photons.insert(mixed.photons.end(), photons.begin(), photons.end());
  }
  if (!mixed.photons.empty()) trees_.push_back(std::move(mixed));
  parallel_for(static_cast<std::int64_t>(trees_.size()), 1, [&](std::int64_t i) {
    Tree& tree = trees_[static_cast<std::size_t>(i)];
    tree.sort(), tree.build_nodes();
  });
}

std::size_t MediumPhotons::bytes() const {
  std::size_t sum = 0;
  for (const Tree& tree : trees_) {
    sum += tree.photons.capacity() * sizeof(Placed);
    for (const auto& level : tree.levels) sum += level.capacity() * sizeof(Node);
  }
  return sum;
}

/// Photons at the same place stay in the order of the traces.
void MediumPhotons::Tree::sort() {
  Bounds3 box;
  for (const Placed& placed : photons) box.add(placed.photon->p);
  UntouchedVector<AlongZCurve> order(photons.size());
  parallel_for(static_cast<std::int64_t>(order.size()), 1 << 12, [&](std::int64_t i) {
    const auto number = static_cast<std::uint32_t>(i);
    order[number] = {place_along_z_curve(photons[number].photon->p, box), number};
  });
  parallel_sort(order);
  std::vector<Placed> sorted;
  sorted.reserve(photons.size());
  for (const AlongZCurve& next : order) sorted.push_back(photons[next.number]);
  photons = std::move(sorted);
}

void MediumPhotons::Tree::build_nodes() {
  levels.clear();
  std::vector<Bounds3> boxes((photons.size() + kWidth - 1) / kWidth);
  for (std::size_t i = 0; i < photons.size(); ++i) boxes[i / kWidth].add(photons[i].photon->p);
  while (!boxes.empty()) {
    std::vector<Node>& level = levels.emplace_back((boxes.size() + kWidth - 1) / kWidth);
    std::vector<Bounds3> parents(level.size());
    for (std::size_t i = 0; i < level.size() * kWidth; ++i) {
      const Bounds3 box = i < boxes.size() ? boxes[i] : Bounds3();
      const float planes[] = {box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z};
      for (std::size_t p = 0; p < 6; ++p) level[i / kWidth].planes[p][i % kWidth] = planes[p];
      parents[i / kWidth].add(box);
    }
    if (level.size() == 1) return;
    boxes = std::move(parents);
  }
}

MediumPhotons::Test::Test(const CameraBeam& beam, float scale)
    : origin{beam.ray.origin.x, beam.ray.origin.y, beam.ray.origin.z},
      direction{beam.ray.direction.x, beam.ray.direction.y, beam.ray.direction.z},
      begin(beam.begin),
      end(beam.end),
      radius(scale * beam.radius),
      spread(scale * beam.spread),
      least(scale * beam.least),
      most(scale * beam.most) {
  constexpr float kLeast = 1e-12f;  // so that no plane's distance is 0 / 0
  for (int axis = 0; axis < 3; ++axis)
    inverse[axis] = 1 / (std::abs(direction[axis]) < kLeast ? std::copysign(kLeast, direction[axis]) : direction[axis]);
}

/// A box counts with the beam's radius around it. That is largest at one of the ends of the part of the beam that lies beside
/// the box.
unsigned MediumPhotons::Test::near(const Node& node) const {
  float enter[kWidth], leave[kWidth], first[kWidth], last[kWidth];
  for (std::size_t i = 0; i < kWidth; ++i) first[i] = last[i] = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float o = origin[axis], d = direction[axis];
    for (std::size_t i = 0; i < kWidth; ++i) {
      const float low = (node.planes[2 * axis][i] - o) * d, high = (node.planes[2 * axis + 1][i] - o) * d;
      first[i] += std::min(low, high), last[i] += std::max(low, high);
    }
  }
  float around[kWidth];
  for (std::size_t i = 0; i < kWidth; ++i) {
    const float a = std::abs(radius + spread * std::max(begin, first[i])),
                b = std::abs(radius + spread * std::min(end, last[i]));
    around[i] = std::clamp(std::max(a, b), least, most) * 1.0001f;
    enter[i] = begin, leave[i] = end;
  }
  // In the ray's order, so that boxes that are inside out are never entered.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float o = origin[axis], inv = inverse[axis], towards = inv < 0 ? -1.f : 1.f;
    const auto &near = node.planes[2 * axis + (inv < 0)], &far = node.planes[2 * axis + (inv >= 0)];
    for (std::size_t i = 0; i < kWidth; ++i) {
      enter[i] = std::max(enter[i], (near[i] - towards * around[i] - o) * inv);
      leave[i] = std::min(leave[i], (far[i] + towards * around[i] - o) * inv);
    }
  }
  unsigned bits = 0;
  for (std::size_t i = 0; i < kWidth; ++i) bits |= static_cast<unsigned>(enter[i] <= leave[i]) << i;
  return bits;
}

}  // namespace dspm
