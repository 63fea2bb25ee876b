#include "dspm/session/exposure.h"

#include <cstdint>

#include "dspm/base/math/rng.h"
#include "dspm/integrators/camera_numbers.h"

namespace dspm {

double delay_of(int iteration, const Shutter& shutter, const RenderSettings& render) {
  const auto number = static_cast<std::uint64_t>(iteration);
  const auto [first, length] = IterationBlock::of(number);
  const auto place = static_cast<std::uint32_t>(number - first);
  const float u = PathRandom::even(render.seed, Stream::shutter, first, place).number(0, 0);
  return shutter.open + (shutter.close - shutter.open) * static_cast<double>(u);
}

Iteration Exposure::iteration(int number) {
  if (!job_.shutter.is_open()) return {number, scene_};
  const double delay = delay_of(number, job_.shutter, job_.settings);
  later_scene_.reset();
  later_world_ = world_.after(delay);
  later_scene_ = later_world_->scene(scene_.file_frames);
  return {number, *later_scene_, delay};
}

}  // namespace dspm
