// The options that say which files a render writes, and when.
#include <fmt/format.h>

#include <filesystem>

#include "dspm/app/options/image_options.h"
#include "dspm/app/options/option_group.h"
#include "dspm/app/options/option_values.h"
#include "dspm/base/system/extension.h"
#include "dspm/output/write_image.h"

namespace dspm {
namespace {

void add_file_options(CLI::App& app, Options& o) {
  app.add_option("-o,--outfile", o.outfile,
                 "the images' name, .exr, .png, .webp, .pfm or .hdr; #### or %04d stands for the frame, {legs} for the "
                 "choice along an axis")
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_flag("--png", o.png, "also write tone mapped PNGs");
  add_image_options(app, o);
  app.add_option("--contact-sheet,--sheet", o.contact_sheet,
                 "write all frames into one PNG, or each row as an animation: .webp, .apng")
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_option("--index", o.index, "write a table of all images and what they show, .csv or .json")
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_option("--video", o.video, "write all frames into one .mp4, at the rate of Frames; needs ffmpeg")
      ->check(kNamesAFile)
      ->type_name("FILE");
  add_text(app, "--write-every", "TIME", "write the images so far: every 30s, 10m, or so many iterations",
           [&](const std::string& text) { o.write_every = parse_interval("--write-every", text); });
  app.add_option("--checkpoint", o.checkpoint, "keep the state of the render in this file, for --resume")
      ->check(kNamesAFile)
      ->type_name("FILE");
  add_text(app, "--checkpoint-every", "TIME", "how often: every 30s, 10m (the default), or so many iterations",
           [&](const std::string& text) { o.checkpoint_every = parse_interval("--checkpoint-every", text); });
  app.add_option("--resume", o.resume, "continue from this checkpoint, with frames added since, and keep it up to date")
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_flag("--only-new", o.only_new,
               "with --resume: render only frames that the checkpoint lacks, up to its iteration");
  CLI::Option* const save_guide =
      app.add_option("--save-guide", o.save_guide, "keep what is learned about where photons start, for --guide")
          ->check(kNamesAFile)
          ->type_name("FILE");
  app.add_option("--guide", o.guide, "start photons as this file says, and learn nothing")
      ->check(kNamesAFile)
      ->excludes(save_guide)
      ->type_name("FILE");
  app.add_flag("--quiet", o.quiet, "only errors and warnings");
  app.add_flag("--stats{table}", o.stats,
               "print a table of times, counts and what more threads would do; with FILE: as JSON")
      ->type_name("[=FILE]");
}

void check_outfile(const Options& o) {
  if (o.outfile.empty()) return;
  if (o.task == Task::to_dsc) {
    if (extension_of(o.outfile) != ".dsc") throw UsageError("-o " + o.outfile + ": --to-dsc writes a .dsc");
    if (o.scenes.size() > 1) throw UsageError("-o " + o.outfile + ": --to-dsc writes a file for each scene");
  } else if (!is_image_name(o.outfile)) {
    throw UsageError(fmt::format("-o {}: images are written as {}", o.outfile, kImageNames));
  }
}

void check_file_options(const Options& o) {
  check_outfile(o);
  if (!o.contact_sheet.empty() && !is_sheet_name(o.contact_sheet))
    throw UsageError(fmt::format("--contact-sheet {}: the sheet is a {}", o.contact_sheet, kSheetNames));
  if (const std::string kind = extension_of(o.index); !o.index.empty() && kind != ".csv" && kind != ".json")
    throw UsageError("--index " + o.index + ": the table is a .csv or a .json");
  if (!o.video.empty() && extension_of(o.video) != ".mp4")
    throw UsageError("--video " + o.video + ": the video is an .mp4");
  if (o.only_new && o.resume.empty())
    throw UsageError("--only-new: new since when? Give --resume and a checkpoint, too");
  if (o.checkpoint_every && o.checkpoint.empty() && o.resume.empty() && o.task != Task::farm)
    throw UsageError("--checkpoint-every: which file? Give --checkpoint or --resume, too");
}

}  // namespace

const OptionGroup file_options = {add_file_options, check_file_options};

}  // namespace dspm
