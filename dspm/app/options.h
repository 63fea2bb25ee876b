// The options of the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/app/onlooker_settings.h"
#include "dspm/checkpoint/checkpoints.h"
#include "dspm/output/output.h"
#include "dspm/params/errors.h"
#include "dspm/serve/access.h"
#include "dspm/session/write_schedule.h"
#include "dspm/world/choices.h"

namespace dspm {

enum class Task {
  render,
  check,
  format,
  upgrade,
  list,
  describe,
  list_variations,
  to_dsc,
  new_plugin,
  relight,
  compare,
  flicker
};

struct Options : Choices, OutputSettings, CheckpointSettings, OnlookerSettings {
  Task task = Task::render;
  std::vector<std::string> scenes;   // "-": standard input; for Task::relight, images and factors
  std::vector<std::string> modules;  // files with plugins
  std::string sandbox;               // the directory outside of which no file is touched; empty: no sandbox
  std::string described;             // [kind:]name
  std::string guide, save_guide;     // files; empty: none
  std::vector<std::string> created;  // a new plugin's kind, name and folder
  std::string progress;              // a kind of progress, see progress_kind(); empty: the usual one
  bool explain = false, quiet = false;

  std::optional<ServeAddress> serve;  // where the live page is

  Interval write_every;
  int threads = 0;         // 0: all
  double time_limit = 0;   // seconds; 0: none
  double patience = 60;    // seconds before a message says who does not return
  std::size_t memory = 0;  // bytes that a run may take; 0: no bound
};

/// `--help` and `--version`: text for standard output, and nothing else to do.
struct Information {
  std::string text;
};

/// Throws UsageError or Information.
Options parse_options(const std::vector<std::string>& arguments);

}  // namespace dspm
