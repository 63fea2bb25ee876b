// The query for rays in many frames.
#include "words.h"

#include "dspm/accel/plain_query.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {

struct QueryInput {
  PlainQuery query;
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
  output->blocked = input->query.occluded(input->ray, input->frames);
  for (const FrameHit& part : input->query.partition(input->ray, input->frames)) {
    output->distances += part.hit.t;
    if (!part.hit.missed()) output->met |= part.frames;
  }
}
