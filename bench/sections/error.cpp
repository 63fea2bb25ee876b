// How long each integrator, estimator and way of direct light takes to the same error against a long-run reference.
#include "bench/measure/convergence.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

// Times as multiples of dsppm's: of each of the reference's two runs, and of sppm and path.
constexpr double kReference = 8, kSlow = 4;

/// Small images, because references take long; as many photons per pixel as 300,000 on 512 x 512.
Choices small(const Setup& setup, const char* integrator) {
  Choices choices;
  choices.defines = setup.defines;
  choices.quick = true;
  choices.integrator = integrator;
  return choices;
}

std::vector<Method> photon_methods(const Job& given, int photons) {
  const Job job = with_integer(given, "photons", photons);
  const auto with = [&](const char* estimator, const char* direct) {
    return with_text(with_text(job, "estimator", estimator), "direct", direct);
  };
  return {{"kz11", "dsppm", with("kz11", "photons")},
          {"hj09", "dsppm", with("hj09", "photons")},
          {"kz11, direct light sampled", "dsppm", with("kz11", "sampled")},
          {"hj09, direct light sampled", "dsppm", with("hj09", "sampled")},
          {"sppm, kz11", "sppm", with("kz11", "photons")}};
}

/// With seeds that no method uses, and with radii that shrink faster: less bias, and enough time against noise.
struct Reference {
  Images truth;
  double uncertainty;  // half the difference of two independent runs
};

Reference make_reference(const LoadedScene& loaded, int photons, double seconds) {
  Images runs[2];
  for (int i = 0; i < 2; ++i) {
    Job job = with_text(loaded.job, "estimator", i == 0 ? "kz11" : "hj09");
    job = with_number(with_integer(std::move(job), "photons", photons), "alpha", 0.5f);
    job.settings.seed += 1000 + static_cast<std::uint64_t>(i);
    runs[i] = render_for(loaded, {"reference", "dsppm", job}, seconds);
  }
  return {mean_of(runs[0], runs[1]), error_of(runs[0], runs[1]) / 2};
}

struct Curve {
  std::string name;
  std::vector<ErrorPoint> points;
};

std::string table_of(const std::vector<Curve>& curves, double seconds) {
  const double aim = error_after(curves[1].points, seconds / 4);  // of hj09
  Table table({"method", fmt::format("error after {} s", seconds), fmt::format("seconds to {:.4f}", aim),
               "over those of kz11"});
  const double kz11 = time_to(curves[0].points, aim);
  for (const Curve& curve : curves) {
    const double time = time_to(curve.points, aim);
    table.row({curve.name, fmt::format("{:.4f}", error_after(curve.points, seconds)),
               time > 0 ? fmt::format("{:.2f}", time) : fmt::format("more than {:.0f}", curve.points.back().seconds),
               time > 0 && kz11 > 0 ? ratio_cell(time / kz11) : ""});
  }
  return table.text();
}

PlotFile plot_of(const std::string& scene, const std::vector<Curve>& curves) {
  LinePlot plot{
      "Error over time: " + scene, "seconds", "relative error", Scale::logarithmic, Scale::logarithmic, {}, {}};
  for (const Curve& curve : curves) {
    LineSeries series{curve.name, {}};
    for (const ErrorPoint& p : curve.points) series.points.push_back({p.seconds, p.error});
    plot.series.push_back(series);
  }
  return {"error-" + scene, svg_of(plot)};
}

Findings measure_one(const std::filesystem::path& file, const Setup& setup) {
  const std::string name = file.stem().string();
  const LoadedScene loaded = load(file, small(setup, "dsppm")), for_path = load(file, small(setup, "path"));
  const double seconds = setup.quick ? 1.5 : 8;
  const int photons = static_cast<int>(300000. * loaded.job.settings.crop.count() / (512 * 512));
  say("{}: reference", name);
  const Reference reference = make_reference(loaded, photons, kReference * seconds);
  std::vector<Curve> curves;
  std::vector<Method> methods = photon_methods(loaded.job, photons);
  methods.push_back({"path", "path", for_path.job});
  for (const Method& method : methods) {
    say("{}: {}", name, method.name);
    const bool slow = std::string_view(method.integrator) != "dsppm";
    const LoadedScene& scene = &method == &methods.back() ? for_path : loaded;
    curves.push_back({method.name, converge(scene, method, reference.truth, (slow ? kSlow : 1) * seconds)});
  }
  const auto& size = loaded.job.settings.crop;
  return {fmt::format(
              "\n{}, {} frames of {} x {} pixels, {} photons per iteration; the reference is uncertain by {:.4f}:\n\n",
              name, loaded.job.frames.size(), size.width(), size.height(), photons, reference.uncertainty) +
              table_of(curves, seconds) + "\n" + plot_link("error-" + name, "Error over time, " + name),
          {plot_of(name, curves)}};
}

std::vector<std::filesystem::path> scene_files(const Setup& setup) {
  if (!setup.scene.empty()) return {setup.scene};
  if (setup.quick) return {our_scene("demo")};
  return {our_scene("demo"), our_scene("horse"), our_scene("disco"), our_scene("water"), our_scene("material")};
}

}  // namespace

Findings measure_error(const Setup& setup) {
  Findings all;
  for (const std::filesystem::path& file : scene_files(setup)) {
    try {
      Findings one = measure_one(file, setup);
      all.text += one.text;
      all.plots.insert(all.plots.end(), one.plots.begin(), one.plots.end());
    } catch (const Skipped& why) {
      all.text += fmt::format("\n{}: SKIPPED, {}\n", file.stem().string(), why.what());
    }
  }
  return all;
}

}  // namespace dspm
