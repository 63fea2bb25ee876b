// What the command line asks for.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/frames.h"

namespace dspm {

enum class Task { render, check, format, list, describe, list_variations, new_plugin };

/// Every so many seconds or iterations; both zero: never.
struct Interval {
  double seconds = 0;
  int iterations = 0;
};

struct Options {
  Task task = Task::render;
  std::vector<std::string> scenes;   // "-": standard input
  std::vector<std::string> defines;  // name=value
  std::vector<std::string> modules;  // files that bring plugins along
  std::string sandbox;               // the directory beyond which no file is touched; empty: there is none
  std::string described;             // [kind:]name
  std::vector<std::string> created;  // a new plugin's kind, name and folder
  bool lenient = false, explain = false, quiet = false, quick = false;

  std::string outfile;  // empty: the Film's filename
  std::string contact_sheet, video;
  bool png = false;
  std::optional<bool> half;  // what the Film says otherwise
  Interval write_every;
  std::string checkpoint, resume;            // files
  std::optional<Interval> checkpoint_every;  // else every ten minutes
  std::string stats;                         // "table", or a file for JSON ("-": standard output); empty: no statistics
  bool stats_in_file() const { return !stats.empty() && stats != "table" && stats != "-"; }

  int threads = 0;  // 0: all
  std::optional<std::uint64_t> seed;
  std::string integrator, accel;  // empty: what the scene says
  std::optional<int> iterations, photons;
  double time_limit = 0;                             // seconds; 0: none
  double patience = 60;                              // seconds, before it is told who does not come back
  std::size_t memory = 0;                            // bytes that a run may take; 0: no bound
  std::vector<Frame> frames;                         // of the animation, ascending; empty: all
  std::vector<std::string> variations;               // patterns of names; empty: all
  std::optional<std::array<double, 4>> crop_window;  // x0, x1, y0, y1 in parts of the image
  std::optional<std::array<int, 4>> pixel_bounds;    // x0, x1, y0, y1 in pixels
};

/// A command line that makes no sense (exit code 2).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `--help` and `--version`: text for standard output, and nothing else to do.
struct Information {
  std::string text;
};

/// Throws UsageError or Information.
Options parse_options(const std::vector<std::string>& arguments);

}  // namespace dspm
