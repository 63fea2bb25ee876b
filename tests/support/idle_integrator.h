// An integrator that renders nothing, for tests of what holds its state.
#pragma once

#include "dspm/integrators/integrator.h"

namespace dspm::test {

class IdleIntegrator : public Integrator {
 public:
  int iterations() const override { return 1; }
  std::string settings() const override { return {}; }
  void iterate(const Iteration&) override {}
  Image estimate(Frame, const std::string&) const override { return {}; }
  Statistics statistics() const override { return {}; }
};

}  // namespace dspm::test
