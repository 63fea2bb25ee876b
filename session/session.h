// A render without a command line: frame intervals one after the other, each iterated until its iterations are done,
// its error is small enough, its time is up, or the observer wants an end. The observer decides what happens to the
// images.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/load.h"
#include "dspm/session/memory_bound.h"
#include "dspm/session/observer.h"
#include "dspm/session/part.h"
#include "dspm/session/run_warnings.h"
#include "dspm/session/stage.h"
#include "dspm/session/write_schedule.h"

namespace dspm {

struct SessionSettings {
  double time_limit = 0;              // seconds for all intervals; 0: none
  Interval write_every;               // of the images so far
  std::size_t bytes_for_writing = 0;  // kept free during an iteration, to write images if memory runs out
  // Seconds. Shorter iterations end within the ten seconds that a Ctrl-C leaves them, so they do without a copy of the
  // state and are not cancelled.
  double long_iteration = 5;
  Part part = {};  // of all iterations
  /// Makes an integrator that other machines help, from an interval's integrator and another one like it: its
  /// iterate(i) does all iterations of a block of that size. The stage is the interval's; `all` is the number of
  /// iterations of the interval, 0 if it runs until stopped. If empty, the integrator iterates alone.
  std::function<std::unique_ptr<Integrator>(std::size_t interval, Stage& stage, std::unique_ptr<Integrator>,
                                            std::unique_ptr<Integrator>, int all)>
      share_out = {};
  int block = 1;
  std::vector<Places> places = {};  // of the first intervals, which earlier runs began; the others' are their frames
};

class Session {
 public:
  /// `intervals` come from `memory`.plan(). All arguments must outlive the session.
  Session(const LoadedScene& loaded, const std::vector<FrameList>& intervals, const MemoryBound& memory,
          const SessionSettings& settings, Messages& messages, SessionObserver& observer);

  /// Renders all intervals, or until the observer wants an end. Throws SceneError if the scene cannot be rendered after
  /// all, UsageError if the render would never end, and whatever an iteration throws.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  /// An interval's share of the time. It begins before the scene is made.
  struct Share {
    Clock::time_point begin;
    double limit;  // seconds
  };

  /// Returns the iterations of an interval; 0 if it runs until stopped.
  int iterations_of(const Integrator& integrator) const;
  void render_interval(std::size_t index);
  /// Makes the integrator.
  void equip(Stage& stage, std::size_t index, FrameSet given_up);
  IntervalProgress iterate_to_the_end(std::size_t index, Stage& stage, int iterations, const Share& time);
  /// Returns false if the iteration was cancelled. `expected` is the number of seconds that it may take.
  bool iterate(const IntervalProgress& before, Stage& stage, double expected);
  /// Returns whether a copy of the integrator's state can be afforded.
  bool can_copy(Integrator& integrator, std::size_t index) const;
  void iterate_cancellably(const IntervalProgress& before, Stage& stage, double expected) const;
  /// Warns of what went badly in the interval and, if an error is to be reached, says how large it is.
  void judge(const IntervalProgress& progress, const Integrator& integrator);
  void write(const IntervalProgress& progress, Integrator& integrator, SessionObserver::Images images);
  /// Returns the seconds for the interval: an equal share of the time that the intervals before it left. Infinite
  /// without a limit.
  double time_share(std::size_t index) const;

  const LoadedScene& loaded_;
  const std::vector<FrameList>& intervals_;
  const MemoryBound& memory_;
  const SessionSettings settings_;
  Messages& messages_;
  SessionObserver& observer_;
  const std::string integrator_;  // as messages name it
  RunWarnings warnings_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace dspm
