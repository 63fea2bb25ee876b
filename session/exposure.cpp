#include "dspm/session/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/camera_numbers.h"

namespace dspm {
namespace {

/// Returns the boxes of all that may move, by frame, object and the number of the object's shape.
std::map<std::tuple<Frame, int, int>, Bounds3> boxes_of(const World& world, std::span<const FileFrame> frames) {
  std::map<std::tuple<Frame, int, int>, Bounds3> boxes;
  std::map<std::pair<Frame, int>, int> counts;
  for (const PlacedShape& shape : world.moving_shapes(frames)) {
    Bounds3 box;
    for (int i = 0; i < shape.shape->primitive_count(); ++i) box.add(shape.bounds(i));
    shape.frames.for_each([&](Frame f) { boxes[{f, shape.object, counts[{f, shape.object}]++}] = box; });
  }
  return boxes;
}

/// Returns how many of its own widths anything passes from one world to the other. The width is the middle one of the three
/// sides of its box: that of a rod is its thickness, that of a plate not.
double widths_passed(const World& first, const World& last, std::span<const FileFrame> frames) {
  const auto begin = boxes_of(first, frames), end = boxes_of(last, frames);
  double most = 0;
  for (const auto& [which, box] : begin) {
    const auto found = end.find(which);
    if (found == end.end()) continue;
    const Vec3 size = box.high - box.low, way = found->second.center() - box.center();
    const float width = std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
    if (width > 0) most = std::max(most, static_cast<double>(length(way) / width));
  }
  return most;
}

/// Returns how far the picture's middle turns, in pixels there.
double pixels_turned(const World& first, const World& last, std::span<const FileFrame> frames,
                     const RenderSettings& render) {
  const Vec2 middle{static_cast<float>(render.width) / 2, static_cast<float>(render.height) / 2}, lens{0.5f, 0.5f};
  double most = 0;
  for (const auto& begin : first.cameras(frames).states)
    for (const auto& end : last.cameras(frames).states) {
      if ((begin.frames & end.frames).empty()) continue;
      const Vec3 from = begin.object->ray(middle, lens).direction, to = end.object->ray(middle, lens).direction;
      const float pixel = begin.object->pixel_spacing(1) - begin.object->pixel_spacing(0);
      if (pixel > 0) most = std::max(most, static_cast<double>(length(to - from) / pixel));
    }
  return most;
}

}  // namespace

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
  const std::string times =
      job.moments == 1 ? "one time of it"
                       : fmt::format("{} times of it, each to a part of the pixels, as something is fast", job.moments);
  return {fmt::format(
      "shutter: open from {} to {} frames after each frame's moment; meanwhile {} may change. Each iteration "
      "shows {}, the same in all frames.",
      job.shutter.open, job.shutter.close, fmt::join(moves, ", "), times)};
}

int moments_of_an_iteration(const Job& job, const World& opening, const World& closing) {
  constexpr int kMost = 7;
  constexpr double kWidths = 16, kPixels = 128;  // that one moment is enough for
  if (!job.plugin->sees_moments) return 1;
  const std::vector<FileFrame> frames = opening.sample_frames();
  const double needed = std::max(widths_passed(opening, closing, frames) / kWidths,
                                 pixels_turned(opening, closing, frames, job.settings) / kPixels);
  // Of sixteen iterations each width of the way then sees two moments; their number is odd, see Exposure::iteration().
  return needed <= 1 ? 1 : std::min(kMost, 2 * static_cast<int>(std::ceil(std::min(needed, 4.) - 0.5)) + 1);
}

void Exposure::colour(Scene& scene, int number) {
  if (!job_.settings.spectral) return;
  scene.set_palette(
      Palette::of_iteration(job_.settings.seed, static_cast<std::uint64_t>(number), job_.film.sensor.get()));
}

Iteration Exposure::iteration(int number) {
  colour(scene_, number);
  if (!job_.shutter.delays()) return {number, scene_};
  const double delay = delay_of(number, job_.shutter, job_.settings), length = job_.shutter.close - job_.shutter.open;
  later_.clear(), moments_.clear();
  for (int moment = 0; moment < job_.moments; ++moment) {
    // Each pixel's times are as even as those of one moment: they are the same, turned around the shutter. As the number of
    // moments is odd, they divide the gaps evenly that 8, 16, 32, ... iterations leave.
    const double share = (delay - job_.shutter.open) / length + moment / (8. * job_.moments);
    Later& later = later_.emplace_back();
    later.world = world_.after(moment == 0 ? delay : job_.shutter.open + length * (share - std::floor(share)));
    later.scene = later.world->scene(scene_.file_frames, &scene_);
    later.scene->set_palette(scene_.palette);
    moments_.push_back(later.scene.get());
  }
  return {number, *moments_.front(), delay, moments_};
}

}  // namespace dspm
