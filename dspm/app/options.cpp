#include "dspm/app/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "dspm/app/image_options.h"
#include "dspm/app/option_values.h"
#include "dspm/output/write_image.h"
#include "dspm/params/errors.h"
#include "dspm/system/version.h"

namespace dspm {
namespace {

constexpr int kMaxCount = 1'000'000'000, kMaxThreads = 1024;
constexpr const char* kDescription =
    "dspm renders all frames of a scene together and shares the work that they have in common.\n"
    "Exit codes: 0 done, 1 the scene or the render failed, 2 usage, 130 interrupted (images are written).\n";

/// Else "" would count as an option that is not given.
const CLI::Validator kNamesAFile([](const std::string& name) { return name.empty() ? "a file's name is missing" : ""; },
                                 "");

using ReadText = std::function<void(const std::string&)>;

void add_text(CLI::App& app, const char* names, const char* value, const char* sentence, const ReadText& read) {
  app.add_option_function<std::string>(names, read, sentence)->type_name(value);
}

template <class Count>
void add_count(CLI::App& app, const char* names, Count& count, int lowest, int highest, const char* sentence) {
  app.add_option(names, count, sentence)->check(CLI::Range(lowest, highest).description(""))->type_name("N");
}

void add_scene(CLI::App& app, Options& o) {
  app.add_option("scene", o.scenes,
                 "scene files (.dsc or .pbrt, optionally .gz), read in this order; -: standard input")
      ->type_name("");
  app.add_option("-D", o.defines, "replace $name in the scene's text")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  app.add_option("--plugin", o.modules, "load the plugins of this module, such as ./libambient.so; may be repeated")
      ->allow_extra_args(false)
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_option("--sandbox", o.sandbox, "for untrusted scenes: touch no file outside of DIR, load no plugins")
      ->check(kNamesAFile)
      ->type_name("DIR");
  app.add_flag("--lenient", o.lenient, "warn about unsupported features of pbrt instead of stopping");
  app.add_flag("--explain", o.explain,
               "say what is shared between frames and what is not, and why; and where photons start");
  app.add_option("--integrator", o.integrator,
                 "dsppm, sppm, photonmap, path, vcm or ambientocclusion, whatever the scene says")
      ->type_name("NAME");
  app.add_option("--accel", o.accel, "the tree for ray queries: two-level, or bruteforce for tests")->type_name("NAME");
}

void add_tasks(CLI::App& app, Options& o) {
  const auto task = [&](const char* name, Task what, const char* sentence) {
    app.add_flag_callback(name, [&o, what] { o.task = what; })->description(sentence);
  };
  task("--check", Task::check, "do not render, only validate everything: the scene, the files, the video, the memory");
  task("--format", Task::format, "do not render, print the scene in canonical form");
  task("--upgrade", Task::upgrade, "do not render, print a file for pbrt-v3 as one for pbrt-v4");
  task("--list", Task::list, "print the names of all plugins");
  task("--list-variations", Task::list_variations, "print the names of the scene's variations");
  task("--relight", Task::relight,
       "do not render, mix images' light groups again: dspm --relight a.exr \"key 0.5 [1 .8 .6]\" -o b.exr");
  add_text(app, "--describe", "[KIND:]NAME", "print a plugin's parameters, such as those of material:dielectric",
           [&](const std::string& name) { o.task = Task::describe, o.described = name; });
  app.add_option_function<std::vector<std::string>>(
         "--new-plugin", [&](const std::vector<std::string>& words) { o.task = Task::new_plugin, o.created = words; },
         "write a starter project for a plugin: integrator ambient my-folder")
      ->expected(3)
      ->type_name("KIND NAME DIR");
}

void add_work(CLI::App& app, Options& o) {
  add_count(app, "-t,--nthreads", o.threads, 0, kMaxThreads, "threads (default: one per core)");
  // Image headers keep it as a double.
  app.add_option("--seed", o.seed, "seed of the random numbers")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53).description(""))
      ->type_name("N");
  add_count(app, "--iterations,--spp", o.iterations, 0, kMaxCount, "camera paths per pixel; 0: until stopped");
  add_count(app, "--photons", o.photons, 1, kMaxCount, "photon paths per iteration");
  add_text(app, "--time-limit", "TIME", "stop after this time: 30s, 10m, 1h30m",
           [&](const std::string& text) { o.time_limit = parse_duration("--time-limit", text); });
  add_text(app, "--until-error", "ERROR",
           "stop when every frame's estimated error is below this: 2%, 0.02; half of the pixels are farther off",
           [&](const std::string& text) { o.until_error = parse_share("--until-error", text); });
  add_text(app, "--patience", "TIME", "say who is at work if a step takes longer than this (default: 1m)",
           [&](const std::string& text) { o.patience = parse_duration("--patience", text); });
  add_text(app, "--memory", "BYTES", "keep within this memory: 2G, 800M, 1.5Gi; images change by rounding only",
           [&](const std::string& text) { o.memory = parse_bytes("--memory", text); });
  add_text(app, "--frames", "LIST", "render these frames only: 1-8,12, or every fourth: 1-32:4",
           [&](const std::string& text) { o.frames = parse_frames(text); });
  app.add_option("--variation", o.variations, "render these variations only: oak-red, 'oak-*'; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add_text(app, "--cropwindow", "WINDOW", "render this part of the image only: x0,x1,y0,y1 in 0..1",
           [&](const std::string& text) { o.crop_window = parse_crop_window(text); });
  add_text(app, "--pixelbounds", "WINDOW", "likewise, in pixels",
           [&](const std::string& text) { o.pixel_bounds = parse_pixel_bounds(text); });
  app.add_flag("--quick", o.quick, "a quarter of the width, of the height and of the iterations");
}

void add_output(CLI::App& app, Options& o) {
  app.add_option("-o,--outfile", o.outfile,
                 "the images' name; #### or %04d stands for the frame, {legs} for the choice along an axis")
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_flag("--png", o.png, "also write tone mapped PNGs");
  add_image_options(app, o);
  app.add_option("--contact-sheet", o.contact_sheet, "write all frames into one PNG")
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
  app.add_flag("--stats{table}", o.stats, "print a table of times and counts at the end; with FILE: as JSON");
}

void add_serve(CLI::App& app, std::string& address) {
  app.add_flag("--serve{8780}", address,
               "show all frames in a browser while they get better, at 127.0.0.1; other addresses: 0.0.0.0:8780");
}

std::string help_of(const CLI::App& app) {
  std::string help = app.help();
  show_optional_values(help);
  return help;
}

/// A port after --serve belongs to it.
std::vector<std::string> with_address_of_page(const std::vector<std::string>& words) {
  std::vector<std::string> joined;
  for (const std::string& word : words) {
    const bool is_address = !joined.empty() && joined.back() == "--serve" && parse_serve_address(word);
    is_address ? void(joined.back() += "=" + word) : joined.push_back(word);
  }
  return joined;
}

ServeAddress address_of_page(const Options& o, const std::string& text) {
  const auto refuse = [](const std::string& why) { throw UsageError("--serve " + why); };
  const std::optional<ServeAddress> address = parse_serve_address(text);
  if (!address) refuse(text + ": expected a port or an address, such as 8080 or 0.0.0.0:8080");
  if (o.task != Task::render) refuse("shows a render, and nothing is rendered");
  if (o.memory > 0) refuse("and --memory exclude each other: viewers take memory that no plan knows");
  if (std::find(o.scenes.begin(), o.scenes.end(), "-") != o.scenes.end())
    refuse("reads the scene more than once, so it cannot come from standard input");
  return *address;
}

std::vector<std::string> long_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  return names;
}

/// The first argument that no option takes, and what was meant.
std::string unexpected(const CLI::App& app) {
  const std::string argument = app.remaining().empty() ? "" : app.remaining().front();
  const std::string guess = did_you_mean(argument.substr(argument.find_first_not_of('-')), long_names(app));
  return "there is no option " + argument + (guess.empty() ? "" : "; " + guess) + " (dspm --help lists all)";
}

void check(const Options& o) {
  const bool needs_scene = o.task != Task::list && o.task != Task::describe && o.task != Task::new_plugin;
  if (needs_scene && o.scenes.empty()) throw UsageError("no scene was given (dspm --help says how)");
  if (o.crop_window && o.pixel_bounds) throw UsageError("--cropwindow and --pixelbounds exclude each other");
  if (!o.outfile.empty() && !is_image_name(o.outfile))
    throw UsageError(fmt::format("-o {}: images are written as {}", o.outfile, kImageNames));
  if (!o.contact_sheet.empty() && std::filesystem::path(o.contact_sheet).extension() != ".png")
    throw UsageError("--contact-sheet " + o.contact_sheet + ": the sheet is a .png");
  if (const std::string kind = std::filesystem::path(o.index).extension();
      !o.index.empty() && kind != ".csv" && kind != ".json")
    throw UsageError("--index " + o.index + ": the table is a .csv or a .json");
  if (!o.video.empty() && std::filesystem::path(o.video).extension() != ".mp4")
    throw UsageError("--video " + o.video + ": the video is an .mp4");
  if (o.only_new && o.resume.empty())
    throw UsageError("--only-new: new since when? Give --resume and a checkpoint, too");
  if (o.checkpoint_every && o.checkpoint.empty() && o.resume.empty())
    throw UsageError("--checkpoint-every: which file? Give --checkpoint or --resume, too");
  for (const std::string& define : o.defines)
    if (define.find('=') == define.npos || define.front() == '=')
      throw UsageError("-D " + define + ": expected name=value");
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) {
  Options options;
  CLI::App app(kDescription, "dspm");
  app.get_formatter()->column_width(26);
  app.set_version_flag("--version", fmt::format("dspm {}", kVersion));
  add_scene(app, options);
  add_tasks(app, options);
  add_work(app, options);
  add_output(app, options);
  std::string page;
  add_serve(app, page);

  std::vector<std::string> words = with_address_of_page(canonical_spelling(arguments, long_names(app)));
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    throw Information{help_of(app)};
  } catch (const CLI::CallForVersion& version) {
    throw Information{version.what() + std::string("\n")};
  } catch (const CLI::ExtrasError&) {
    throw UsageError(unexpected(app));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  check(options);
  if (!page.empty()) options.serve = address_of_page(options, page);
  return options;
}

}  // namespace dspm
