// How the error of a progressive integrator falls with time, against a picture that took much longer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/measure/run.h"
#include "dspm/image/image.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// An image a frame.
using Images = std::vector<Image>;

/// The mean over frames and pixels of |a - b| / (b + 1% of b's mean luminance), of luminance, at most 1 a pixel:
/// relative, as dark parts are seen too, and neither a lamp's edge nor a firefly weighs more than a pixel that is all
/// wrong.
double error_of(const Images& images, const Images& truth);

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

/// The images of `method` after so many seconds.
Images render_for(const LoadedScene& loaded, const Method& method, double limit);

/// An image of each of the scene's frames after so many iterations; `seed` is added to the job's.
Images rendered(const Scene& scene, const char* integrator, Job job, int seed, int iterations);

/// What frames converge to: the mean of two runs whose seeds no comparison takes, and whose radii shrink faster (alpha
/// 0.5), so that there is less bias.
Images long_run(const Scene& scene, const Job& job, int iterations);

/// The pixels' mean of both.
Images mean_of(const Images& a, const Images& b);

/// When `curve` comes down to `error`: a power law between its points, its first one where that is below; 0 where it
/// does not.
double time_to(std::span<const ErrorPoint> curve, double error);
/// The error after so many seconds, likewise; beyond its ends the curve's first or last.
double error_after(std::span<const ErrorPoint> curve, double seconds);

}  // namespace dspm
