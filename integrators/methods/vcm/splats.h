// Light that light subpaths send to places of the film, and its sum over pixels.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/seen_light.h"

namespace dspm {

struct Splat {
  Vec2 film;  // in pixels of the full image
  FrameSet frames;
  Rgb radiance;   // of a pixel that sees this place only, for one pixel of film
  int light;      // the light that it comes from: an index of the scene
  bool caught;    // the place is on a shadow catcher
  bool of_media;  // as in SeenLight
};

/// Returns whether a pixel of the crop sees the place.
bool is_seen(Vec2 film, const RenderSettings& render);

/// Adds the splats, in their order, to every pixel of the crop whose filter reaches them.
void add_splats(std::span<const std::span<const Splat>> splats, const RenderSettings& render, SeenLightSums& sums);

}  // namespace dspm
