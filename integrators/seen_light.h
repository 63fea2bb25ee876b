// Sums of the light that camera paths saw, by pixel and frame, and of its parts by group of lights.
#pragma once

#include <cstdint>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/pixel_frames.h"

namespace dspm {

/// Light that a camera path saw without photons: emission or sampled direct light, as radiance times throughput.
/// It is what the palette of its iteration sees (Palette::seen).
struct SeenLight {
  FrameSet frames;
  Rgb radiance;
  int pixel;
  int light = -1;         // the light that it comes from: an index of the scene; -1: not known
  bool caught = false;    // on a shadow catcher: see caught_light.h
  bool of_media = false;  // they have sent it to the camera before the first surface
};

class SeenLightSums {
 public:
  SeenLightSums(int pixels, int frames, LightGroups groups = {}, bool has_catchers = false)
      : pixels_(pixels),
        sums_(pixels, frames),
        caught_(has_catchers ? pixels : 0, frames),
        groups_(std::move(groups)),
        parts_(std::int64_t{groups_.count()} * pixels, frames) {}
  /// The bytes of the sums for that many pixels, frames and groups.
  static std::size_t bytes(int pixels, int frames, int groups = 0) {
    return PixelFrames<Rgb>::bytes(std::int64_t{pixels} * (1 + groups), frames);
  }

  void add(const SeenLight& light) {
    PixelFrames<Rgb>& sums = light.caught ? caught_ : sums_;
    light.frames.for_each([&](Frame f) { sums.at(light.pixel, f) += light.radiance; });
    if (has_parts() && !light.caught) add_to_part(light);
  }
  bool has_parts() const { return !parts_.empty(); }
  /// Adds the light to the sum of its group, not to the whole.
  void add_to_part(const SeenLight& light) {
    add_to_part(light, groups_.of_light(light.light));
    if (light.of_media) add_to_part(light, groups_.of_media());
  }
  void add_to_part(const SeenLight& light, int group) {
    if (group == LightGroups::kNone) return;
    light.frames.for_each([&](Frame f) { parts_.at(row(group, light.pixel), f) += light.radiance; });
  }
  /// The mean over all iterations, including those whose path saw nothing; with a `group`, the mean of that group's
  /// light.
  Rgb mean(int pixel, Frame frame, int iterations, int group = LightGroups::kNone) const {
    if (iterations == 0) return {};
    const Rgb& sum = group == LightGroups::kNone ? sums_.at(pixel, frame) : parts_.at(row(group, pixel), frame);
    return sum / static_cast<float>(iterations);
  }
  Rgb mean_caught(int pixel, Frame frame, int iterations) const {
    return iterations == 0 ? Rgb() : caught_.at(pixel, frame) / static_cast<float>(iterations);
  }
  const LightGroups& groups() const { return groups_; }
  void persist(StateStream& state) {
    state.sum(sums_.values());
    if (!caught_.empty()) state.sum(caught_.values());
    if (has_parts()) state.sum(parts_.values());
  }
  std::size_t bytes() const { return sums_.bytes() + caught_.bytes() + parts_.bytes(); }

 private:
  std::int64_t row(int group, int pixel) const { return group * pixels_ + pixel; }

  std::int64_t pixels_;
  PixelFrames<Rgb> sums_;
  PixelFrames<Rgb> caught_;  // empty: the scene has no catchers
  LightGroups groups_;
  PixelFrames<Rgb> parts_;  // group by group
};

}  // namespace dspm
