// Rays as arrays: row by row where they start, where they go and in which frames.
#pragma once

#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "python/chunks.h"

namespace dspm::python {

struct Rays {
  std::vector<Ray> rays;
  std::vector<FrameSet> frames;
  std::vector<int> row;  // of what the ray was made from

  std::size_t size() const { return rays.size(); }
  void add(const Ray& ray, FrameSet in, int from) { rays.push_back(ray), frames.push_back(in), row.push_back(from); }
  Rays& operator+=(const Rays& o) {
    append(rays, o.rays), append(frames, o.frames), append(row, o.row);
    return *this;
  }
};

/// Radiance that arrives along rays, or leaves surfaces, in groups of frames that agree.
struct Radiance {
  std::vector<int> row;
  std::vector<FrameSet> frames;
  std::vector<Rgb> radiance;
  std::vector<float> pdf_w;  // by solid angle, with which sample_lights() at the ray's origin draws its direction

  void add(int of, FrameSet in, const Rgb& value, float pdf) {
    row.push_back(of), frames.push_back(in), radiance.push_back(value), pdf_w.push_back(pdf);
  }
  Radiance& operator+=(const Radiance& o) {
    append(row, o.row), append(frames, o.frames), append(radiance, o.radiance), append(pdf_w, o.pdf_w);
    return *this;
  }
};

}  // namespace dspm::python
