// An integrator whose images are means over iterations that are independent of one another: it adds to sums, and what a
// sum needs to be saved, resumed and shared out among machines is done here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/summed_iterations.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class SummingIntegrator : public Integrator {
 public:
  std::vector<OutputInfo> outputs() const override { return with_caught_light(with_radiance(groups_), has_catchers_); }
  Image estimate(Frame frame, const std::string& output) const override { return done_.mean(frame, output); }
  Statistics statistics() const override { return done_.statistics(); }
  bool persist(StateStream& state) override {
    done_.persist(state);
    return true;
  }
  std::string why_not_in_parts() const override { return {}; }

 protected:
  /// Takes the statistics before the first iteration, `begin`, without bytes.
  SummingIntegrator(int frames, const RenderSettings& render, Statistics begin)
      : done_(render.crop, frames, std::move(begin)) {}
  /// Also sums caught light and, if it `has_groups`, the light of each group as an output.
  SummingIntegrator(const Scene& scene, const RenderSettings& render, Statistics begin, bool has_groups = true)
      : groups_(has_groups ? light_group_outputs(scene) : std::vector<OutputInfo>()),
        has_catchers_(has_catchers(scene)),
        done_(render.crop, scene.frame_count(), std::move(begin),
              has_groups ? LightGroups(scene, render.outputs) : LightGroups(), has_catchers_) {}

 private:
  std::vector<OutputInfo> groups_;
  bool has_catchers_ = false;

 protected:
  SummedIterations done_;
};

}  // namespace dspm
