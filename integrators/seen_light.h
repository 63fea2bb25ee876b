// Sums of the light that camera paths saw, by pixel and frame, and of its parts by group of lights.
#pragma once

#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/light_groups.h"

namespace dspm {

/// Light that a camera path saw without photons: emission or sampled direct light, as radiance times throughput.
struct SeenLight {
  FrameSet frames;
  Rgb radiance;
  int pixel;
  int light = -1;       // the light that it comes from: an index of the scene; -1: not known
  bool caught = false;  // on a shadow catcher: see caught_light.h
};

class SeenLightSums {
 public:
  SeenLightSums(int pixels, int frames, LightGroups groups = {}, bool has_catchers = false)
      : frames_(frames),
        sums_(bytes(pixels, frames) / sizeof(Rgb)),
        caught_(has_catchers ? sums_.size() : 0),
        groups_(std::move(groups)),
        parts_(static_cast<std::size_t>(groups_.count()) * sums_.size()) {}
  /// The bytes of the sums for that many pixels, frames and groups.
  static std::size_t bytes(int pixels, int frames, int groups = 0) {
    return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames) * sizeof(Rgb) *
           static_cast<std::size_t>(1 + groups);
  }

  void add(const SeenLight& light) {
    std::vector<Rgb>& sums = light.caught ? caught_ : sums_;
    light.frames.for_each([&](Frame f) { sums[index(light.pixel, f)] += light.radiance; });
    if (has_parts() && !light.caught) add_to_part(light);
  }
  bool has_parts() const { return !parts_.empty(); }
  /// Adds the light to the sum of its group, not to the whole.
  void add_to_part(const SeenLight& light) { add_to_part(light, groups_.of_light(light.light)); }
  void add_to_part(const SeenLight& light, int group) {
    if (group == LightGroups::kNone) return;
    const std::size_t first = static_cast<std::size_t>(group) * sums_.size();
    light.frames.for_each([&](Frame f) { parts_[first + index(light.pixel, f)] += light.radiance; });
  }
  /// The mean over all iterations, including those whose path saw nothing; with a `group`, the mean of that group's
  /// light.
  Rgb mean(int pixel, Frame frame, int iterations, int group = LightGroups::kNone) const {
    if (iterations == 0) return {};
    const std::size_t at = index(pixel, frame);
    const Rgb& sum =
        group == LightGroups::kNone ? sums_[at] : parts_[static_cast<std::size_t>(group) * sums_.size() + at];
    return sum / static_cast<float>(iterations);
  }
  Rgb mean_caught(int pixel, Frame frame, int iterations) const {
    return iterations == 0 ? Rgb() : caught_[index(pixel, frame)] / static_cast<float>(iterations);
  }
  const LightGroups& groups() const { return groups_; }
  void persist(StateStream& state) {
    state.sum(sums_);
    if (!caught_.empty()) state.sum(caught_);
    if (has_parts()) state.sum(parts_);
  }
  std::size_t bytes() const { return (sums_.capacity() + caught_.capacity() + parts_.capacity()) * sizeof(Rgb); }

 private:
  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * static_cast<std::size_t>(frames_) + static_cast<std::size_t>(frame);
  }

  int frames_;
  std::vector<Rgb> sums_;
  std::vector<Rgb> caught_;  // by pixel and frame; empty: the scene has no catchers
  LightGroups groups_;
  std::vector<Rgb> parts_;  // by group, pixel and frame
};

}  // namespace dspm
