// The options of the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/app/options/onlooker_settings.h"
#include "dspm/base/params/errors.h"
#include "dspm/looking/serve/access.h"
#include "dspm/output/output.h"
#include "dspm/session/checkpoint/checkpoints.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/write_schedule.h"

namespace dspm {

enum class Task {
  render,
  check,
  format,
  upgrade,
  list,
  describe,
  doctor,
  completion,
  manual_page,
  list_variations,
  to_dsc,
  new_plugin,
  relight,
  merge,
  farm,
  plan,
  compare,
  flicker
};

struct Options : Choices, OutputSettings, CheckpointSettings, OnlookerSettings {
  Task task = Task::render;
  std::vector<std::string> scenes;   // "-": standard input; for Task::relight, images and factors
  std::vector<std::string> modules;  // files with plugins
  std::string sandbox;               // the directory outside of which no file is touched; empty: no sandbox
  std::string described;             // [kind:]name
  std::string shell;                 // to complete command lines in
  Part frame_part;                   // of the frames
  std::vector<std::string> parts;    // checkpoints to merge
  int plan = 0;                      // machines to plan for
  std::string farm;                  // the kind of farm to write jobs for
  std::optional<int> farm_parts;     // none: 8
  std::optional<int> block;          // iterations that one of several machines does in one go; none: 4
  // The command line in one spelling: what a part's render needs, and what the merge does.
  std::vector<std::string> words_of_render, words_of_images;
  std::string guide, save_guide;     // files; empty: none
  std::vector<std::string> created;  // a new plugin's kind, name and folder
  std::string progress;              // a kind of progress, see progress_kind(); empty: the usual one
  bool explain = false, quiet = false;

  std::optional<ServeAddress> serve;  // where the live page is

  Interval write_every;
  int threads = 0;        // 0: all
  double time_limit = 0;  // seconds; 0: none
  double patience = 60;   // seconds before a message says who does not return
  /// The seconds of silence after which a run with several machines ends without one of them.
  double longest_silence() const { return 10 * patience; }
};

/// `--help` and `--version`: text for standard output, and nothing else to do.
struct Information {
  std::string text;
};

struct OptionFacts;
/// Returns what --help knows of each option.
std::vector<OptionFacts> all_options();
/// Throws UsageError or Information.
Options parse_options(const std::vector<std::string>& arguments);
/// Returns the options of a merge with what its parts rendered, by the words of their command line, unless it names a
/// scene itself.
Options with_scene_of_parts(Options merge, const std::vector<std::string>& words_of_part);

}  // namespace dspm
