// Renders that machines share out.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dspm/app/options/option_group.h"
#include "dspm/app/options/option_values.h"
#include "dspm/app/tasks/tasks.h"

namespace dspm {
namespace {

void add_part_options(CLI::App& app, Options& o) {
  add_text(app, "--part", "P/N",
           "render every Nth iteration only, from the Pth on, into the --checkpoint: 3/8; or an Nth of the frames: "
           "frames:3/8",
           [&](const std::string& text) {
             const Parts parts = parse_parts(text);
             o.part = parts.iterations, o.frame_part = parts.frames;
             o.images = o.part.is_all();
           });
  app.add_option_function<std::vector<std::string>>(
         "--merge", [&](const std::vector<std::string>& files) { o.task = Task::merge, o.parts = files; },
         "do not render, add up the checkpoints of parts, and write all that a render would")
      ->check(kNamesAFile)
      ->type_name("FILES");
  app.add_option_function<int>(
         "--plan", [&](int machines) { o.task = Task::plan, o.plan = machines; },
         "do not render, print how so many machines can share the render, and what it takes, from trial iterations")
      ->check(CLI::Range(2, Part::kMost).description(""))
      ->type_name("N");
  app.add_option_function<std::string>(
         "--farm", [&](const std::string& kind) { o.task = Task::farm, o.farm = kind; },
         "do not render, print a job for a farm: the parts of this render and their merge; slurm, openjd or flamenco")
      ->check(one_of(farms()))
      ->type_name("KIND");
  add_count(app, "--block", o.block, 1, 1'000'000,
            "with mpirun: iterations that a machine does in one go, before they are added up (default: 4)");
  add_count(app, "--parts", o.farm_parts, 2, Part::kMost, "of a --farm: so many (default: 8)");
}

using Given = std::initializer_list<std::pair<bool, const char*>>;

/// Refuses an option, rather than read one that would do nothing.
void refuse(const char* option, const Given& given, const char* why) {
  for (const auto& [is_given, name] : given)
    if (is_given) throw UsageError(fmt::format("{} and {} exclude each other: {}", option, name, why));
}

void check_part(const Options& o) {
  if (o.checkpoint.empty() && o.resume.empty()) throw UsageError("--part: which file keeps it? Give --checkpoint, too");
  refuse("--part", {{o.until_error > 0, "--until-error"}}, "the error of the whole is not known to a part");
  refuse("--part", {{o.only_new, "--only-new"}}, "all parts hold the same frames");
  refuse("--part",
         {{!o.outfile.empty(), "-o"},
          {o.png, "--png"},
          {!o.contact_sheet.empty(), "--contact-sheet"},
          {!o.index.empty(), "--index"},
          {!o.video.empty(), "--video"},
          {o.write_every.seconds > 0 || o.write_every.iterations > 0, "--write-every"}},
         "a part writes no images, --merge does, and takes it");
}

void check_merge(const Options& o) {
  refuse("--merge",
         {{!o.part.is_all() || !o.frame_part.is_all(), "--part"},
          {o.iterations.has_value(), "--iterations"},
          {o.time_limit > 0, "--time-limit"},
          {o.until_error > 0, "--until-error"},
          {o.write_every.seconds > 0 || o.write_every.iterations > 0, "--write-every"},
          {o.checkpoint_every.has_value(), "--checkpoint-every"},
          {!o.save_guide.empty(), "--save-guide"},
          {o.explain, "--explain"},
          {o.preview, "--preview"},
          {!o.display_server.empty(), "--display-server"}},
         "nothing is rendered");
  refuse("--merge", {{o.memory > 0, "--memory"}}, "the parts know theirs");
  refuse("--merge", {{!o.resume.empty(), "--resume"}}, "--merge writes a --checkpoint, which --resume then continues");
}

void check_farm(const Options& o) {
  refuse("--farm",
         {{!o.part.is_all() || !o.frame_part.is_all(), "--part"},
          {!o.resume.empty(), "--resume"},
          {o.until_error > 0, "--until-error"},
          {o.only_new, "--only-new"},
          {o.write_every.seconds > 0 || o.write_every.iterations > 0, "--write-every"},
          {!o.save_guide.empty(), "--save-guide"},
          {o.explain, "--explain"},
          {o.preview, "--preview"},
          {!o.display_server.empty(), "--display-server"}},
         "its jobs are parts and their merge");
  if (std::find(o.scenes.begin(), o.scenes.end(), "-") != o.scenes.end())
    throw UsageError("--farm: each job reads the scene, so it cannot come from standard input");
}

void check_part_options(const Options& o) {
  if (o.task == Task::farm) check_farm(o);
  if (o.task == Task::plan)
    refuse("--plan",
           {{!o.part.is_all() || !o.frame_part.is_all(), "--part"},
            {!o.resume.empty(), "--resume"},
            {o.memory > 0, "--memory"},
            {o.until_error > 0, "--until-error"}},
           "it plans whole renders");
  if (o.task != Task::farm && o.farm_parts) throw UsageError("--parts: of what? Give --farm, too");
  if (!o.part.is_all()) check_part(o);
  if (o.task == Task::merge) check_merge(o);
}

}  // namespace

const OptionGroup part_options = {add_part_options, check_part_options};

}  // namespace dspm
