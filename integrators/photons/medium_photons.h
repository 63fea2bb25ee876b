// Photons that have collided with media, and the search for those along a beam.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/colour/spectrum.h"
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
  Vec3 w;         // its direction before
  Spectrum flux;  // in W, of what is scattered
  HenyeyGreenstein phase;
  FrameSet frames;
  StrandList strands = 0;    // in its trace's table
  int light = -1;            // the light that it comes from: an index of the scene
  int medium;                // likewise
  std::int16_t only_nm = 0;  // as in Photon
};

/// Photons of one medium that exist in the same frames have a hierarchy of boxes of their own if they are many, so that a beam
/// in few frames does not visit those of others. Nothing depends on threads.
class MediumPhotons {
 public:
  /// Sorts the photons of all `traces`, which must outlive this object.
  void build(const std::vector<PhotonTrace>& traces);

  std::size_t size() const { return count_; }
  std::size_t bytes() const;

  struct Placed {
    const MediumPhoton* photon;
    const Strand* strands;
    std::uint32_t number;  // in the order of the traces
  };
  /// Calls fn(const Placed&, distance along the beam's ray, radius there squared) for every photon of the beam's frames within
  /// `scale` times the beam's radius of it, and for some of other frames; returns how many it tested.
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
  /// In the order of a curve that fills space: eight photons in a leaf, eight boxes in a node.
  struct Tree {
    FrameSet frames;  // of any of them
    int medium = kMixed;
    std::vector<Placed> photons;
    std::vector<std::vector<Node>> levels = {};  // from the leaves' boxes to the root

    void sort();
    void build_nodes();
    template <class Fn>
    std::uint64_t for_each_along(const CameraBeam& beam, const Test& test, float scale, Fn&& fn) const;
  };
  static constexpr int kMixed = -1;
  static constexpr std::size_t kMany = 512;  // photons

  std::size_t count_ = 0;
  std::vector<Tree> trees_;
};

template <class Fn>
std::uint64_t MediumPhotons::for_each_along(const CameraBeam& beam, float scale, Fn&& fn) const {
  const Test test(beam, scale);
  std::uint64_t tested = 0;
  for (const Tree& tree : trees_)
    if (!(tree.frames & beam.frames).empty() && (tree.medium == kMixed || tree.medium == beam.medium))
      tested += tree.for_each_along(beam, test, scale, fn);
  return tested;
}

template <class Fn>
std::uint64_t MediumPhotons::Tree::for_each_along(const CameraBeam& beam, const Test& test, float scale,
                                                  Fn&& fn) const {
  struct Entry {
    std::uint32_t level, node;
  };
  std::array<Entry, 8 * 16> stack;
  std::size_t count = 0;
  stack[count++] = {static_cast<std::uint32_t>(levels.size() - 1), 0};
  std::uint64_t tested = 0;
  while (count > 0) {
    const Entry entry = stack[--count];
    const unsigned near = test.near(levels[entry.level][entry.node]);
    for (unsigned i = kWidth; i-- > 0;) {
      if ((near >> i & 1) == 0) continue;
      const auto child = static_cast<std::uint32_t>(entry.node * kWidth + i);
      if (entry.level > 0) {
        stack[count++] = {entry.level - 1, child};
        continue;
      }
      const std::size_t first = child * kWidth, last = std::min(first + kWidth, photons.size());
      tested += last - first;
      for (std::size_t n = first; n < last; ++n) {
        const MediumPhoton& photon = *photons[n].photon;
        const Vec3 way = photon.p - beam.ray.origin;
        const float t = dot(way, beam.ray.direction), radius = scale * beam.radius_at(t);
        if (!(t > beam.begin && t < beam.end) || photon.medium != beam.medium) continue;
        if (length2(way - beam.ray.direction * t) < radius * radius) fn(photons[n], t, radius * radius);
      }
    }
  }
  return tested;
}

}  // namespace dspm
