// An integrator whose images are means over iterations that are independent of one another: it adds to sums, and what a
// sum needs to be saved, resumed and shared out among machines is done here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/summed_iterations.h"
#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"

namespace dspm {

class SummingIntegrator : public Integrator {
 public:
  std::vector<OutputInfo> outputs() const override { return with_radiance(groups_); }
  Image estimate(Frame frame, const std::string& output) const override { return done_.mean(frame, output); }
  Statistics statistics() const override { return done_.statistics(); }
  bool persist(StateStream& state) override {
    done_.persist(state);
    return true;
  }
  std::string why_not_in_parts() const override { return {}; }

 protected:
  /// `begin`: the statistics before the first iteration, except bytes.
  SummingIntegrator(int frames, const RenderSettings& render, Statistics begin)
      : done_(render.crop, frames, std::move(begin)) {}
  /// With the light of each group as an output.
  SummingIntegrator(const Scene& scene, const RenderSettings& render, Statistics begin)
      : groups_(light_group_outputs(scene)),
        done_(render.crop, scene.frame_count(), std::move(begin), LightGroups(scene, render.outputs)) {}

 private:
  std::vector<OutputInfo> groups_;

 protected:
  SummedIterations done_;
};

}  // namespace dspm
