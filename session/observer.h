// Watches a session, saves it and stops it. No function needs to be overridden.
#pragma once

#include <optional>
#include <string>

#include "dspm/integrators/integrator.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The progress of a frame interval.
struct IntervalProgress {
  std::size_t index = 0;             // of the interval
  int iterations = 0;                // done, in this run and those that it resumes
  double seconds = 0;                // the time that they and making the scene took
  std::optional<double> error = {};  // of the worst frame, if it is estimated and known; see Statistics::errors
};

class SessionObserver {
 public:
  /// The images of an interval that are due: those after an iteration, those that a failed iteration leaves, or the
  /// last ones.
  enum class Images { so_far, after_failure, last };

  virtual ~SessionObserver() = default;
  /// Called before a step that may take a long time ("iteration 3"). `who` does the work; it may be empty.
  virtual void step_begins(const std::string& /*step*/, const std::string& /*who*/) {}
  /// Called when the first interval is ready to be rendered. `iterations` is the number for each interval; 0 means
  /// until stopped.
  virtual void ready(const Scene&, Integrator&, int /*iterations*/) {}
  /// May load an earlier state into the integrator; returns its progress.
  virtual IntervalProgress interval_begins(std::size_t index, Integrator&) { return {.index = index}; }
  virtual void iteration_done(const IntervalProgress&, Integrator&) {}
  /// Called when it is time to save the images of this interval.
  virtual void images_due(const IntervalProgress&, Integrator&, Images) {}
  /// Called after an iteration threw; the exception then leaves the session. If there are images, images_due comes
  /// first.
  virtual void iteration_failed() {}
  virtual void interval_ends(const IntervalProgress&, const Scene&, Integrator&) {}

  /// Returns whether to end here and write the images so far. Called between iterations.
  virtual bool end_wanted() const { return false; }
  virtual bool images_wanted() { return false; }
  /// Returns how many more iterations are wanted, once the interval has all of its own. May wait for an answer.
  virtual int more_iterations(const IntervalProgress&, Integrator&) { return 0; }
};

}  // namespace dspm
