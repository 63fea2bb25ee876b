#include "dspm/session/exposure.h"

#include <fmt/format.h>

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

std::vector<std::string> explain_shutter(const Job& job) {
  if (!job.shutter.delays()) return {};
  std::vector<std::string> moves = what_moves(*job.description);
  if (moves.empty()) moves.emplace_back("meshes with velocities");
  return {fmt::format(
      "shutter: open from {} to {} frames after each frame's moment; meanwhile {} may change. Each iteration "
      "shows one time of it, the same in all frames.",
      job.shutter.open, job.shutter.close, fmt::join(moves, ", "))};
}

Iteration Exposure::iteration(int number) {
  if (!job_.shutter.delays()) return {number, scene_};
  const double delay = delay_of(number, job_.shutter, job_.settings);
  later_scene_.reset();
  later_world_ = world_.after(delay);
  later_scene_ = later_world_->scene(scene_.file_frames, &scene_);
  return {number, *later_scene_, delay};
}

}  // namespace dspm
