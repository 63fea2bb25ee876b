// Photons that have collided with media, and the search for those along a beam.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/camera_beam.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/media/henyey_greenstein.h"

namespace dspm {

struct PhotonTrace;

/// A photon where it is scattered by a medium.
struct MediumPhoton {
  Vec3 p;
  Vec3 w;    // its direction before
  Rgb flux;  // in W, of what is scattered
  HenyeyGreenstein phase;
  FrameSet frames;
  StrandList strands = 0;  // in its trace's table
  int light = -1;          // the light that it comes from: an index of the scene
  int medium;              // likewise
};

/// A hierarchy of boxes over the photons, in the order of a curve that fills space: eight in a leaf, eight boxes in a node.
/// It does not depend on threads.
class MediumPhotons {
 public:
  /// Sorts the photons of all `traces`, which must outlive this object.
  void build(const std::vector<PhotonTrace>& traces);

  std::size_t size() const { return photons_.size(); }
  std::size_t bytes() const;

  struct Placed {
    const MediumPhoton* photon;
    const Strand* strands;
    std::uint32_t number;  // in the order of the traces
  };
  /// Calls fn(const Placed&, distance along the beam's ray, radius there squared) for every photon within `scale` times the
  /// beam's radius of it; returns how many it tested.
  template <class Fn>
  std::uint64_t for_each_along(const CameraBeam& beam, float scale, Fn&& fn) const;

 private:
  static constexpr std::size_t kWidth = 8;
  /// Boxes of eight children: low and high x, low and high y, low and high z. Those of none are inside out.
  struct Node {
    float planes[6][kWidth];
  };
  /// A beam prepared for tests of boxes.
  struct Test {
    float origin[3], direction[3], inverse[3];
    float begin, end, radius, spread, least, most;

    Test(const CameraBeam& beam, float scale);
    /// Returns the children that the beam may come near to, as bits.
    unsigned near(const Node& node) const;
  };

  void sort();
  void build_nodes();

  std::vector<Placed> photons_;
  std::vector<std::vector<Node>> levels_;  // from the leaves' boxes to the root
};

template <class Fn>
std::uint64_t MediumPhotons::for_each_along(const CameraBeam& beam, float scale, Fn&& fn) const {
  if (levels_.empty()) return 0;
  struct Entry {
    std::uint32_t level, node;
  };
  std::array<Entry, 8 * 16> stack;
  std::size_t count = 0;
  stack[count++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
  const Test test(beam, scale);
  std::uint64_t tested = 0;
  while (count > 0) {
    const Entry entry = stack[--count];
    const unsigned near = test.near(levels_[entry.level][entry.node]);
    for (unsigned i = kWidth; i-- > 0;) {
      if ((near >> i & 1) == 0) continue;
      const auto child = static_cast<std::uint32_t>(entry.node * kWidth + i);
      if (entry.level > 0) {
        stack[count++] = {entry.level - 1, child};
        continue;
      }
      const std::size_t first = child * kWidth, last = std::min(first + kWidth, photons_.size());
      tested += last - first;
      for (std::size_t n = first; n < last; ++n) {
        const MediumPhoton& photon = *photons_[n].photon;
        const Vec3 way = photon.p - beam.ray.origin;
        const float t = dot(way, beam.ray.direction), radius = scale * beam.radius_at(t);
        if (!(t > beam.begin && t < beam.end) || photon.medium != beam.medium) continue;
        if (length2(way - beam.ray.direction * t) < radius * radius) fn(photons_[n], t, radius * radius);
      }
    }
  }
  return tested;
}

}  // namespace dspm
