// The progress of a run, on stderr: a bar with the remaining time on a terminal, a plain line now and then elsewhere,
// or for programs a JSON object per iteration (docs/looking.md).
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/app/run/error_trend.h"

namespace dspm {

/// Returns whether stderr is a terminal, on which a line can be overwritten.
bool stderr_is_terminal();

enum class ProgressKind {
  none,
  lines,
  bar,  // on a line that is overwritten
  json
};
/// Reads "bar", "lines", "json" or "none"; empty means a bar on a terminal, else lines.
ProgressKind progress_kind(std::string_view word);

class Progress {
 public:
  struct Extent {
    int iterations = 0;     // in each interval; 0: until stopped
    double time_limit = 0;  // seconds over all intervals; 0: none
    int intervals = 1;
    double until_error = 0;  // of each interval; 0: none
  };
  Progress(const Extent& extent, ProgressKind kind);
  /// Clears the bar's line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins an interval of which an earlier run has done that many iterations.
  void begin(int interval, int iterations);
  /// Reports that `iterations` of the interval (counted from 0) are done. `error` is the estimated error, if it is
  /// known.
  void step(int interval, int iterations, std::optional<double> error = {});
  /// The interval's images are in their files. `frames`: what they are called; `last`: they do not get better.
  void written(int interval, const std::vector<std::string>& frames, bool last);
  /// How far the run is after that many iterations of the interval.
  struct Outlook {
    double share, seconds;                    // of all work, 0: unknown; so far
    std::optional<double> seconds_left = {};  // if it is known
  };
  Outlook outlook(int interval, int iterations) const;
  /// An iteration is busy with something that has a name of its own; while a Progress lives, it hears of it.
  void note(const char* activity);
  /// Clears the bar's line, as other output follows.
  void clear();

 private:
  double elapsed() const;
  /// Whether a line is due. If so, the next one is not for a while.
  bool is_due();
  /// Over the last one.
  void show(const std::string& bar);
  std::string text(int interval, int iterations) const;
  std::string json(int interval, int iterations) const;
  double share_done(int interval, int iterations) const;

  Extent extent_;
  ErrorTrend trend_;
  ProgressKind kind_;
  double before_ = 0;      // the fraction that earlier runs have done
  double next_ = 0;        // seconds at which the next line is due
  std::size_t width_ = 0;  // of the bar's line on the terminal
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace dspm
