// An integrator that wraps another one and does something besides: whatever it does not override is the other's.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"

namespace dspm {

class WrappingIntegrator : public Integrator {
 public:
  int iterations() const override { return inner_->iterations(); }
  std::string settings() const override { return inner_->settings(); }
  void iterate(const Iteration& iteration) override { inner_->iterate(iteration); }
  std::vector<OutputInfo> outputs() const override { return inner_->outputs(); }
  Image estimate(Frame frame, const std::string& output) const override { return inner_->estimate(frame, output); }
  Statistics statistics() const override { return inner_->statistics(); }
  bool persist(StateStream& state) override { return inner_->persist(state); }
  std::string why_not_in_parts() const override { return inner_->why_not_in_parts(); }

 protected:
  explicit WrappingIntegrator(std::unique_ptr<Integrator> inner) : inner_(std::move(inner)) {}

  const std::unique_ptr<Integrator> inner_;
};

}  // namespace dspm
