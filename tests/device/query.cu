// The query for rays in many frames.
#include "words.h"

#include <cstdint>

#include "dspm/accel/plain_query.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/cutout.h"

namespace dspm {

/// Holes of no texture.
struct StripedHoles {
  const std::uint64_t* keys;

  constexpr bool stops(int shape, const Ray& ray, int primitive, Vec2 uv) const {
    return dspm::stops(uv.x, ray, keys[shape], primitive, uv);
  }
};

struct QueryInput {
  PlainQuery query;
  StripedHoles holes;
  Ray ray;
  FrameSet frames;
};
struct QueryOutput {
  float distances;
  FrameSet met, blocked;
};

}  // namespace dspm

extern "C" __global__ void query(const dspm::QueryInput* input, dspm::QueryOutput* output) {
  using namespace dspm;
  output->blocked = input->query.occluded(input->ray, input->frames, NoHoles());
  for (const FrameHit& part : input->query.partition(input->ray, input->frames, input->holes)) {
    output->distances += part.hit.t;
    if (!part.hit.missed()) output->met |= part.frames;
  }
}
