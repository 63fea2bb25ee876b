// The steps of a run, one after the other: each ends when the next one begins. Steps of the same name are added up.
#pragma once

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "dspm/integrators/statistics.h"

namespace dspm {

class StepLog {
 public:
  void begin(const std::string& name) {
    timer_.reset();
    for (StepTime& step : steps_)
      if (step.name == name) return void(timer_.emplace(step));
    timer_.emplace(steps_.emplace_back(StepTime{name}));
  }
  /// Ends the last step and returns all steps.
  std::vector<StepTime> end() {
    timer_.reset();
    return {steps_.begin(), steps_.end()};
  }

 private:
  std::list<StepTime> steps_;
  std::optional<StepTimer> timer_;
};

}  // namespace dspm
