// Nanoseconds that a ray takes in dspm's trees and in Embree alone: the rays of an iteration of sppm, in one frame, asked
// again on one thread. The two take turns; the ratio is the median over the turns.
#include <algorithm>
#include <cmath>

#include "bench/measure/bare_embree.h"
#include "bench/measure/cpu_time.h"
#include "bench/measure/recorded_rays.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

volatile float g_sink;  // keeps answers from being optimised away

struct Turns {
  std::vector<double> ours, embree, ratios;  // nanoseconds a ray
};

template <class Ask>
double nanoseconds(const std::vector<AskedRay>& rays, const Ask& ask) {
  const double start = cpu_seconds();
  for (const AskedRay& asked : rays) g_sink = ask(asked);
  return 1e9 * (cpu_seconds() - start) / static_cast<double>(std::max<std::size_t>(1, rays.size()));
}

template <class Ours, class Embree>
Turns take_turns(const std::vector<AskedRay>& rays, int turns, const Ours& ours, const Embree& embree) {
  Turns taken;
  for (int turn = 0; turn < turns; ++turn) {
    taken.ours.push_back(nanoseconds(rays, ours));
    taken.embree.push_back(nanoseconds(rays, embree));
    taken.ratios.push_back(taken.ours.back() / taken.embree.back());
  }
  return taken;
}

/// The share of rays whose nearest hits differ by more than rounding: those along edges, which the two may give to either side.
double disagreement(const std::vector<AskedRay>& rays, const Accel& accel, const BareEmbree& embree) {
  std::size_t apart = 0;
  for (const AskedRay& asked : rays) {
    const float ours = accel.partition(asked.ray, asked.frames)[0].hit.t, theirs = embree.nearest(asked.ray);
    apart += ours != theirs && !(std::abs(ours - theirs) <= 1e-3f * theirs);
  }
  return static_cast<double>(apart) / static_cast<double>(std::max<std::size_t>(1, rays.size()));
}

void add_row(Table& table, const char* name, const char* kind, std::size_t rays, const Turns& turns,
             const std::string& apart) {
  table.row({name, kind, fmt::format("{:.0f} k", 1e-3 * static_cast<double>(rays)),
             fmt::format("{:.0f}", median(turns.ours)), fmt::format("{:.0f}", median(turns.embree)),
             ratio_cell(median(turns.ratios)), apart});
}

void compare(Table& table, const char* name, const LoadedScene& loaded, const Setup& setup) {
  say("{}", name);
  const Run run = start(loaded, with_text(loaded.job, "direct", "sampled"), "sppm", {loaded.job.frames.front()});
  run.integrator->iterate(0, *run.scene);
  const RecordedRays rays = record(run, 1, setup.quick ? 100'000 : 400'000);
  const Accel& accel = *run.scene->accel;
  const BareEmbree embree(run.scene->shapes);
  const int turns = setup.quick ? 9 : 21;
  add_row(table, name, "nearest hit", rays.nearest.size(),
          take_turns(
              rays.nearest, turns, [&](const AskedRay& r) { return accel.partition(r.ray, r.frames)[0].hit.t; },
              [&](const AskedRay& r) { return embree.nearest(r.ray); }),
          fmt::format("{:.1e}", disagreement(rays.nearest, accel, embree)));
  add_row(
      table, name, "shadow", rays.shadow.size(),
      take_turns(
          rays.shadow, turns, [&](const AskedRay& r) { return accel.occluded(r.ray, r.frames).empty() ? 0.f : 1.f; },
          [&](const AskedRay& r) { return embree.occluded(r.ray) ? 1.f : 0.f; }),
      "");
}

}  // namespace

Findings measure_rays(const Setup& setup) {
  Table table({"scene", "rays", "number", "dspm, ns a ray", "Embree, ns a ray", "ratio", "hits that differ"});
  for (const char* name : {"glassball", "blob"})
    compare(table, name, load(foreign(fmt::format("bench/{}.pbrt", name))), setup);
  compare(table, "Sibenik", load_sibenik_horse(), setup);
  compare(table, "a million triangles", load(std::filesystem::path(DSPM_SOURCE_DIR) / "bench/million.dsc"), setup);
  return {table.text(), {}};
}

}  // namespace dspm
