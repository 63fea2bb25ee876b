#include "dspm/integrators/photons/medium_photons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {
namespace {

constexpr int kBits = 21;  // of a place along each axis

/// Spreads the lowest bits out, two zeros after each.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= (std::uint64_t{1} << kBits) - 1;
  v = (v | v << 32) & 0x1f00000000ffffu;
  v = (v | v << 16) & 0x1f0000ff0000ffu;
  v = (v | v << 8) & 0x100f00f00f00f00fu;
  v = (v | v << 4) & 0x10c30c30c30c30c3u;
  return (v | v << 2) & 0x1249249249249249u;
}

/// Returns the place of a point on Morton's curve through the box.
std::uint64_t place_on_curve(const Vec3& p, const Bounds3& box) {
  const Vec3 size = box.extent(), from = p - box.low;
  const auto cell = [](float from_low, float width) {
    constexpr float kCells = static_cast<float>(1 << kBits) - 1;
    return width > 0 ? static_cast<std::uint64_t>(std::clamp(from_low / width, 0.f, 1.f) * kCells) : 0;
  };
  return spread_bits(cell(from.x, size.x)) | spread_bits(cell(from.y, size.y)) << 1 |
         spread_bits(cell(from.z, size.z)) << 2;
}

}  // namespace

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
  struct Key {
    std::uint64_t place;
    std::uint32_t index;
  };
  std::vector<Key> keys(photons.size());
  parallel_for(static_cast<std::int64_t>(keys.size()), 1 << 12, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    keys[at] = {place_on_curve(photons[at].photon->p, box), static_cast<std::uint32_t>(i)};
  });
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return a.place != b.place ? a.place < b.place : a.index < b.index; });
  std::vector<Placed> sorted;
  sorted.reserve(photons.size());
  for (const Key& key : keys) sorted.push_back(photons[key.index]);
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
