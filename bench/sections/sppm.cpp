// Seconds per iteration of sppm on a box with glass and a box with a fine mesh, measured like other renderers.
#include <array>

#include "bench/measure/child.h"
#include "bench/measure/turns.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

struct Row {
  const char* direct;
  StepSeconds seconds{};
  double rays = 0;  // per iteration
};

/// Means over the last two thirds of the iterations.
Row measure(const LoadedScene& loaded, const char* direct, int iterations) {
  const Run run = start(loaded, with_text(loaded.job, "direct", direct), "sppm", loaded.job.frames);
  Row row{direct};
  const int first = iterations / 3;
  for (int i = 0; i < iterations; ++i) {
    const StepSeconds taken = timed_iteration(run, i);
    for (std::size_t s = 0; i >= first && s < taken.size(); ++s) row.seconds[s] += taken[s] / (iterations - first);
  }
  const Statistics s = run.integrator->statistics();
  row.rays = static_cast<double>(s.camera.segments.done + s.photon.segments.done + s.camera.shadow_rays) / iterations;
  return row;
}

double peak_bytes(const std::filesystem::path& scene, int iterations) {
  return run_dspm({scene.string(), "--integrator=sppm", fmt::format("--iterations={}", iterations)}).peak_bytes;
}

/// Seconds per iteration of others, as reported to us: nothing here runs them.
struct Peer {
  const char* name;
  double glassball, blob;
  const char* memory;
};
constexpr std::array<Peer, 3> kPeers = {
    {{"pbrt-v4, sppm", 2.29, 2.54, "205 to 229 MiB"},
     {"pbrt-v3, sppm", 1.48, 1.85, "176 to 210 MiB"},
     {"Tungsten, progressive photon map (one radius for all pixels)", 0.29, 0.37, "1.6 GiB"}}};

}  // namespace

Findings measure_sppm(const Setup& setup) {
  const int iterations = setup.quick ? 12 : 48;
  Table table({"scene", "direct light", "all, s", "hit points", "photons", "photon map", "statistics", "rays",
               "peak memory, MiB"});
  for (const char* name : {"glassball", "blob"}) {
    const std::filesystem::path file = foreign(fmt::format("bench/{}.pbrt", name));
    const double memory = peak_bytes(file, iterations);
    const LoadedScene loaded = load(file);
    for (const char* direct : {"photons", "sampled"}) {
      say("{}, direct light: {}", name, direct);
      const Row row = measure(loaded, direct, iterations);
      std::vector<std::string> cells = {name, direct, seconds_cell(row.seconds.back())};
      for (std::size_t s = 0; s + 1 < kStepNames.size(); ++s) cells.push_back(seconds_cell(row.seconds[s]));
      cells.push_back(fmt::format("{:.2f} M", row.rays * 1e-6));
      cells.push_back(std::string(direct) == "photons" ? fmt::format("{:.0f}", memory / 1048576) : "");
      table.row(cells);
    }
  }
  Table peers({"others, not measured in this run", "glassball, s", "blob, s", "peak memory"});
  for (const Peer& peer : kPeers)
    peers.row({peer.name, ratio_cell(peer.glassball), ratio_cell(peer.blob), peer.memory});
  return {
      table.text() +
          "\nThe next table is quoted: measured once before 2026-11-21 on another machine (2 cores of the Sapphire "
          "Rapids class), 2 threads, means of iterations 17 to 48 at the same settings. None of it was run together "
          "with the measurements above.\n\n" +
          peers.text(),
      {}};
}

}  // namespace dspm
