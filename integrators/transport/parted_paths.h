// Camera paths whose frames part at their end, postponed until a tile is traced: dynamic objects have their own
// vertices and tree in each frame, and tracing frame by frame keeps them in the cache.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "dspm/integrators/transport/camera_path.h"

namespace dspm {

class PartedPaths {
 public:
  void add(const CameraPath& path, const HitPartition& parts) {
    for (const FrameHit& part : parts) waiting_.push_back({part, static_cast<std::uint32_t>(paths_.size())});
    paths_.push_back(path);
  }

  /// Calls fn(const CameraPath&, const FrameHit&) for each part, in the order of their lowest frames.
  template <class Fn>
  void for_each(Fn&& fn) {
    std::stable_sort(waiting_.begin(), waiting_.end(), [](const Waiting& a, const Waiting& b) {
      return a.part.frames.lowest() < b.part.frames.lowest();
    });
    for (const Waiting& w : waiting_) fn(paths_[w.path], w.part);
  }

 private:
  struct Waiting {
    FrameHit part;
    std::uint32_t path;
  };
  std::vector<CameraPath> paths_;
  std::vector<Waiting> waiting_;
};

}  // namespace dspm
