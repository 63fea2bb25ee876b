// The state of an integrator that keeps only sums. An iteration works on a copy, so one that throws changes
// nothing.
#pragma once

#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/image/film/pixel_rect.h"
#include "dspm/image/image.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/seen_light.h"
#include "dspm/integrators/statistics.h"

namespace dspm {

class SummedIterations {
 public:
  /// Takes the statistics before the first iteration, `begin`, without bytes.
  SummedIterations(const PixelRect& crop, int frames, Statistics begin, LightGroups groups = {},
                   bool has_catchers = false)
      : crop_(crop),
        done_{SeenLightSums(crop.count(), frames, std::move(groups), has_catchers), std::move(begin)},
        next_(done_) {
    done_.statistics.bytes = bytes();
  }
  static std::size_t bytes(int pixels, int frames, int groups = 0, bool has_catchers = false) {
    return 2 * SeenLightSums::bytes(pixels, frames, groups + (has_catchers ? 1 : 0));
  }
  std::size_t bytes() const { return done_.sums.bytes() + next_.sums.bytes(); }

  /// Runs one more iteration: work(sums, statistics) adds to its arguments.
  template <class Work>
  void advance(Work&& work) {
    next_ = done_;
    work(next_.sums, next_.statistics);
    ++next_.statistics.iterations;
    std::swap(done_, next_);
  }

  const Statistics& statistics() const { return done_.statistics; }
  /// Returns the mean of radiance, of the light of a group, or of caught light, as `output` says.
  Image mean(Frame frame, const std::string& output = kRadiance) const {
    const int group = done_.sums.groups().of_output(output);
    Image image(crop_.width(), crop_.height());
    for (int pixel = 0; pixel < crop_.count(); ++pixel)
      image.pixels[static_cast<std::size_t>(pixel)] =
          output == kCaughtLight ? done_.sums.mean_caught(pixel, frame, done_.statistics.iterations)
                                 : done_.sums.mean(pixel, frame, done_.statistics.iterations, group);
    return image;
  }
  void persist(StateStream& state) {
    done_.statistics.persist(state);
    done_.sums.persist(state);
  }

 private:
  struct Sums {
    SeenLightSums sums;
    Statistics statistics;
  };

  PixelRect crop_;
  Sums done_, next_;
};

}  // namespace dspm
