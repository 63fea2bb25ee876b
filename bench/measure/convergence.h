// How the error of a progressive integrator falls with time, against a picture that took much longer.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/measure/run.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// One image per frame.
using Images = std::vector<Image>;

/// The mean over frames and pixels of |a - b| / (b + 1% of b's mean luminance), of luminance, at most 1 per pixel:
/// relative, because dark areas are seen too, and bounded, so that neither a lamp's edge nor a firefly counts more than
/// a completely wrong pixel.
double error_of(const Images& images, const Images& truth);
/// What a pixel counts in it; the floor is that hundredth.
double error_of(const Rgb& pixel, const Rgb& truth, double floor);
double error_floor(const Image& truth);

struct ErrorPoint {
  int iterations;
  double seconds, error;
};

/// A way to render all frames of a scene.
struct Method {
  std::string name;
  const char* integrator;  // one that renders a frame at a time renders all frames, one after the other
  Job job;
};

/// The error after 1, 2, 4, ... iterations, until they took `limit` seconds (of the integrator's steps).
std::vector<ErrorPoint> converge(const LoadedScene& loaded, const Method& method, const Images& truth, double limit);
/// With an error of another kind.
std::vector<ErrorPoint> converge(const LoadedScene& loaded, const Method& method,
                                 const std::function<double(const Images&)>& error, double limit);

/// The images of `method` after that many seconds.
Images render_for(const LoadedScene& loaded, const Method& method, double limit);

/// An image of each of the scene's frames after that many iterations; `seed` is added to the job's.
Images rendered(const Scene& scene, const char* integrator, Job job, int seed, int iterations);

/// The reference: the mean of two runs with seeds that no comparison uses, and with radii that shrink faster (alpha
/// 0.5), for less bias.
Images long_run(const Scene& scene, const Job& job, int iterations);

/// Pixel by pixel.
Images mean_of(const Images& a, const Images& b);

/// When `curve` falls to `error`, by a power law between its points; that of its first point if it is below already, 0
/// if it never falls so low.
double time_to(std::span<const ErrorPoint> curve, double error);
/// The error after that many seconds, likewise; beyond the curve's ends its first or last.
double error_after(std::span<const ErrorPoint> curve, double seconds);

}  // namespace dspm
