// What traces waves in tests: the CPU's threads, and machines that do things in random orders.
#pragma once

#include <memory>
#include <vector>

#include "dspm/integrators/waves/devices.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/wave_tracer_on.h"
#include "tests/integrators/random_machine.h"

namespace dspm::test {

/// Tracers that have the scene, which must be plain and outlive them.
class Tracers {
 public:
  explicit Tracers(const Scene& scene) : plain_(scene) {
    all_.push_back(tracer_on(Device::waves));
    all_.push_back(std::make_unique<WaveTracerOn<RandomMachine>>(7, 700));
    for (const auto& tracer : all_) tracer->load(plain_.scene());
  }

  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }

 private:
  PlainObjects plain_;
  std::vector<std::unique_ptr<WaveTracer>> all_;
};

}  // namespace dspm::test
