// A scene as Python sees it, and warnings as Python raises them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dspm/session/load.h"
#include "dspm/session/renderer.h"

namespace dspm::python {

/// Held by a type of its own: Python's Scene is what was read, not the scene of a frame interval.
struct ReadScene {
  std::shared_ptr<const LoadedScene> loaded;
  std::string digest;  // of all that its images depend on
};

/// Keeps warnings while Python's lock is given away.
class KeptWarnings {
 public:
  Warn keeper() {
    return [this](const std::string& text) { texts_.push_back(text); };
  }
  /// Gives them to Python's `warnings`.
  void raise() const;

 private:
  std::vector<std::string> texts_;
};

}  // namespace dspm::python
