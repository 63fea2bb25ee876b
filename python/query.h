// The query that dspm stands on, for arrays of rays: what do they meet first in each of these frames?
#pragma once

#include <memory>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/load.h"
#include "dspm/world/scene/scene.h"
#include "python/rays.h"

namespace dspm::python {

/// The partitions of rays by their first hits, one after the other. A miss is a part, with shape -1 and infinite t.
struct Parts {
  std::vector<int> ray;
  std::vector<FrameSet> frames;
  std::vector<RayHit> hits;

  std::size_t size() const { return ray.size(); }
  void add(int of, const FrameHit& part) { ray.push_back(of), frames.push_back(part.frames), hits.push_back(part.hit); }
  Parts& operator+=(const Parts& o) {
    append(ray, o.ray), append(frames, o.frames), append(hits, o.hits);
    return *this;
  }
};

/// The scene of up to 64 frames, which may be queried.
struct Query {
  std::shared_ptr<const LoadedScene> loaded;
  std::unique_ptr<const Scene> scene;
};

}  // namespace dspm::python
