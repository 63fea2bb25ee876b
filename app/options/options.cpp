#include "dspm/app/options/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dspm/app/options/image_options.h"
#include "dspm/app/options/option_facts.h"
#include "dspm/app/options/option_group.h"
#include "dspm/app/options/option_values.h"
#include "dspm/app/tasks/version_text.h"
#include "dspm/base/params/errors.h"

namespace dspm {
namespace {

constexpr const char* kDescription =
    "dspm renders all frames of a scene together and shares the work that they have in common.\n"
    "Exit codes: 0 done, 1 the scene or the render failed, 2 usage, 130 interrupted (images are written).\n";

/// The groups in the order of --help.
constexpr const OptionGroup* kGroups[] = {&scene_options, &task_options,    &work_options,
                                          &file_options,  &looking_options, &part_options};

void add_serve(CLI::App& app, std::string& address) {
  app.add_flag("--serve{8780}", address,
               "show all frames in a browser while they get better, at 127.0.0.1; other addresses: 0.0.0.0:8780")
      ->type_name(" [PORT]");
}

/// Joins values to flags that may have one: a port after --serve, and oidn after --denoise.
std::vector<std::string> with_values_of_flags(const std::vector<std::string>& words) {
  std::vector<std::string> joined;
  for (const std::string& word : words) {
    const std::string before = joined.empty() ? "" : joined.back();
    const bool is_value =
        (before == "--serve" && parse_serve_address(word)) || (before == "--denoise" && word == "oidn");
    is_value ? void(joined.back() += "=" + word) : joined.push_back(word);
  }
  return joined;
}

ServeAddress address_of_page(const Options& o, const std::string& text) {
  const auto refuse = [](const std::string& why) { throw UsageError("--serve " + why); };
  const std::optional<ServeAddress> address = parse_serve_address(text);
  if (!address) refuse(text + ": expected a port or an address, such as 8080 or 0.0.0.0:8080");
  if (o.task != Task::render) refuse("shows a render, and nothing is rendered");
  if (!o.part.is_all()) refuse("and --part exclude each other: a page begins anew when the scene changes");
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

/// Options that are given, and where: in parts, in their merge, or in both.
struct Place {
  const char* option;
  bool in_parts, in_merge;
};
constexpr Place kPlaces[] = {
    {"farm", false, false},         {"parts", false, false},        {"outfile", false, true},
    {"png", false, true},           {"contact-sheet", false, true}, {"index", false, true},
    {"video", false, true},         {"view", false, true},          {"background", true, true},
    {"sheet-columns", false, true}, {"sheet-rows", false, true},    {"exposure", false, true},
    {"png-bits", false, true},      {"png-space", false, true},     {"sheet-tile", false, true},
    {"sheet-title", false, true},   {"labels", false, true},        {"half", false, true},
    {"float", false, true},         {"compression", false, true},   {"tiles", false, true},
    {"aov-files", false, true},     {"stats", false, true},         {"checkpoint", false, true},
    {"plugin", true, true},         {"sandbox", true, true},        {"quiet", true, true},
};

void keep_words(const CLI::App& app, Options& o) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_lnames().empty() ? "" : option->get_lnames().front();
    const auto place =
        std::find_if(std::begin(kPlaces), std::end(kPlaces), [&](const Place& each) { return each.option == name; });
    const auto [ignored, in_parts, in_merge] = place != std::end(kPlaces) ? *place : Place{"", true, false};
    for (const std::string& value : option->results()) {
      std::vector<std::string> words = {value};
      if (name.empty() && !option->get_positional()) words = {"-" + option->get_snames().front(), value};
      if (!name.empty() && option->get_expected_max() == 0 && value == "true")
        words = {"--" + name};
      else if (!name.empty() && !option->get_positional())
        words = {"--" + name + "=" + value};
      if (in_parts) o.words_of_render.insert(o.words_of_render.end(), words.begin(), words.end());
      if (in_merge) o.words_of_images.insert(o.words_of_images.end(), words.begin(), words.end());
    }
  }
}

/// Describes the first argument that no option takes, and what may have been meant.
std::string unexpected(const CLI::App& app) {
  const std::string argument = app.remaining().empty() ? "" : app.remaining().front();
  const std::string guess = did_you_mean(argument.substr(argument.find_first_not_of('-')), long_names(app));
  return "there is no option " + argument + (guess.empty() ? "" : "; " + guess) + " (dspm --help lists all)";
}

}  // namespace

namespace {

/// `page` gets the address of --serve, which the other options may forbid.
void add_all(CLI::App& app, Options& options, std::string& page) {
  app.get_formatter()->column_width(26);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);  // so scripts can append to a line
  app.set_help_flag("-h,--help", "print this list");
  app.set_version_flag("--version", version_text, "print the version, and how it was built");
  for (const OptionGroup* group : kGroups) group->add(app, options);
  add_serve(app, page);
}

Options parse_onto(Options options, const std::vector<std::string>& arguments, bool are_all) {
  CLI::App app(kDescription, "dspm");
  std::string page;
  add_all(app, options, page);

  std::vector<std::string> words = with_values_of_flags(canonical_spelling(arguments, long_names(app)));
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    throw Information{help_of(app)};
  } catch (const CLI::CallForVersion& version) {
    throw Information{version.what()};
  } catch (const CLI::ExtrasError&) {
    throw UsageError(unexpected(app));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  if (are_all)
    for (const OptionGroup* group : kGroups)
      if (group->check != nullptr) group->check(options);
  if (!page.empty()) options.serve = address_of_page(options, page);
  options.words = arguments;
  keep_words(app, options);
  return options;
}

}  // namespace

Options parse_options(const std::vector<std::string>& arguments) { return parse_onto({}, arguments, true); }

std::vector<OptionFacts> all_options() {
  Options options;
  std::string page;
  CLI::App app(kDescription, "dspm");
  add_all(app, options, page);
  return facts_of(app);
}

Options with_scene_of_parts(Options merge, const std::vector<std::string>& words_of_part) {
  const Options part = parse_options(words_of_part);
  Options all;
  static_cast<Choices&>(all) = part;
  all.scenes = part.scenes, all.guide = part.guide, all.frame_part = part.frame_part;
  return parse_onto(std::move(all), merge.words, false);
}

}  // namespace dspm
