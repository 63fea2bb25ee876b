// The options that say how much of a scene is rendered, and for how long.
#include "dspm/app/options/option_group.h"
#include "dspm/app/options/option_values.h"

namespace dspm {
namespace {

constexpr int kMaxThreads = 1024;

void add_work_options(CLI::App& app, Options& o) {
  add_count(app, "-t,--nthreads", o.threads, 0, kMaxThreads,
            "threads (default: one per core, within a container's quota)");
  // Image headers keep it as a double.
  app.add_option("--seed", o.seed, "seed of the random numbers")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53).description(""))
      ->type_name("N");
  app.add_option("--noise", o.noise,
                 "of frames: frozen (all share it) or perframe (not those in which the camera has moved)")
      ->check(one_of({"frozen", "perframe"}))
      ->type_name("KIND");
  app.add_option("--colour,--color", o.colour, "rgb or spectral: what paths carry; glass shows its colours either way")
      ->check(one_of({"rgb", "spectral"}))
      ->type_name("KIND");
  app.add_option("--device", o.device,
                 "what traces paths: cpu (the default), gpu, auto (a GPU if there is one and the scene suits it), or waves "
                 "(the CPU as if it were a GPU); images are the same")
      ->check(one_of({"cpu", "waves", "gpu", "auto"}))
      ->type_name("NAME");
  add_count(app, "--iterations,--spp", o.iterations, 0, kMaxCount, "camera paths per pixel; 0: until stopped");
  add_count(app, "--photons", o.photons, 1, kMaxCount, "photon paths per iteration");
  add_count(app, "--maxdepth", o.max_depth, 0, kMaxCount,
            "scatterings of a path at most, whatever the integrator's are");
  add_text(app, "--time-limit", "TIME", "stop after this time: 30s, 10m, 1h30m",
           [&](const std::string& text) { o.time_limit = parse_duration("--time-limit", text); });
  add_text(app, "--until-error", "ERROR",
           "stop when every frame's estimated error is below this: 2%, 0.02; half of the pixels are farther off",
           [&](const std::string& text) { o.until_error = parse_share("--until-error", text); });
  add_text(app, "--patience", "TIME",
           "say who is at work if a step takes longer than this (default: 1m); with mpirun, end if a machine is "
           "silent for ten times as long",
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
  add_text(app, "--resolution", "SIZE", "of the images, whatever the scene says: 50%, 800x600",
           [&](const std::string& text) { o.resolution = parse_resolution(text); });
  app.add_flag("--quick", o.quick,
               "a quarter of the width, of the height and of the iterations, photons in proportion to the pixels");
}

void check_work_options(const Options& o) {
  if (o.crop_window && o.pixel_bounds) throw UsageError("--cropwindow and --pixelbounds exclude each other");
}

}  // namespace

const OptionGroup work_options = {add_work_options, check_work_options};

}  // namespace dspm
