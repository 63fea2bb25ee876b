// The options that say how images are shown: PNGs, the contact sheet and the video. The EXR files do not depend on
// them. Also the options for what is done with images that exist, instead of a scene: dspm --compare a.exr b.exr
#include <fmt/format.h>

#include <stdexcept>

#include "dspm/app/options/option_group.h"
#include "dspm/looking/display_server.h"
#include "dspm/output/view.h"

namespace dspm {
namespace {

constexpr double kMostStops = 64;
constexpr int kMostPixels = 8192;

void set_background(Options& o, const std::string& text) {
  try {
    o.view.background = parse_background(text), o.transparent = true;
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--background {}: {}", text, error.what()));
  }
}

void add_looking_options(CLI::App& app, Options& o) {
  app.add_option(
         "--view", o.view.view,
         "how radiance is shown: agx (the default), agx-punchy, agx-golden, neutral, aces, filmic, standard, raw, or "
         "ocio:DISPLAY/VIEW of $OCIO")
      ->type_name("NAME");
  app.add_option("--exposure", o.view.stops, "show images brighter by so many stops, which may be negative")
      ->check(CLI::Range(-kMostStops, kMostStops).description(""))
      ->type_name("STOPS");
  add_text(app, "--background", "COLOUR",
           "put white, black or #rrggbb behind everything that is shown, with the same numbers under every view",
           [&](const std::string& text) { set_background(o, text); });
  app.add_option("--png-bits", o.view.png_bits, "8 or 16 bits per channel of PNGs (default: 8)")
      ->check(one_of({"8", "16"}))
      ->type_name("N");
  app.add_option_function<std::string>(
         "--png-space", [&](const std::string& name) { o.view.display_p3 = name == "display-p3"; },
         "colour space of PNGs: srgb (the default) or display-p3")
      ->check(one_of({"srgb", "display-p3"}))
      ->type_name("NAME");
  add_count(app, "--sheet-tile", o.sheet.tile_width, 1, kMostPixels, "width of each image on the contact sheet");
  add_count(app, "--sheet-columns", o.sheet.columns, 1, kMostPixels,
            "images in a line of the contact sheet (default: as suits the page)");
  add_count(
      app, "--sheet-rows", o.sheet.lines, 1, kMostPixels,
      "lines on a page of the contact sheet; what does not fit goes to page.0002.png (default: about 150 images)");
  app.add_option("--sheet-title", o.sheet.title, "a title on the contact sheet")->type_name("TEXT");
  app.add_flag("--labels,!--no-labels", o.sheet.labels, "names under the images of a sheet (the default)");
  app.add_option("--display-server", o.display_server, "show images in tev as they get better, such as localhost:14158")
      ->type_name("HOST:PORT");
  app.add_flag("--preview", o.preview, "show the contact sheet in the terminal, if it knows images (kitty, sixel)");
  app.add_option("--progress", o.progress, "bar, lines, json (for programs, on stderr) or none")
      ->check(one_of({"bar", "lines", "json", "none"}))
      ->type_name("KIND");
  app.add_flag_callback("--compare", [&o] { o.task = Task::compare; })
      ->description("do not render, print how far the second image is from the first; -o: in false colours");
  app.add_flag_callback("--flicker", [&o] { o.task = Task::flicker; })
      ->description("do not render, print how much these images (a.####.exr) flicker; -o: in false colours");
  app.add_option("--fps", o.page_fps,
                 "frames per second of a glTF file's animation (24), or of a --video or --sheet of images that exist")
      ->check(CLI::Range(1e-3, 1e3).description(""))
      ->type_name("RATE");
}

void check_looking_options(const Options& o) {
  try {
    if (!o.view.view.empty()) View{o.view};
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--view {}: {}", o.view.view, error.what()));
  }
  try {
    if (!o.display_server.empty()) host_and_port(o.display_server);
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--display-server {}: {}", o.display_server, error.what()));
  }
}

}  // namespace

const OptionGroup looking_options = {add_looking_options, check_looking_options};

}  // namespace dspm
