// Nanoseconds that a ray takes in dspm's trees, whoever built them, and in Embree alone: the rays of an iteration of
// sppm, in one frame, asked again on one thread. All take turns; a ratio is the median over the turns. And what building
// the trees takes.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/measure/bare_embree.h"
#include "bench/measure/cpu_time.h"
#include "bench/measure/recorded_rays.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/accel/two_level.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

volatile float g_sink;  // keeps answers from being optimised away

template <class Ask>
double nanoseconds(const std::vector<AskedRay>& rays, const Ask& ask) {
  const double start = cpu_seconds();
  for (const AskedRay& asked : rays) g_sink = ask(asked);
  return 1e9 * (cpu_seconds() - start) / static_cast<double>(std::max<std::size_t>(1, rays.size()));
}

/// The scene's static trees by either builder, and Embree alone.
struct Rivals {
  TwoLevel own, built_by_embree;
  BareEmbree embree;

  explicit Rivals(const Scene& scene)
      : own(scene.shapes, scene.frames(), BvhBuilder::own),
        built_by_embree(scene.shapes, scene.frames(), BvhBuilder::embree),
        embree(scene.shapes) {}
};

/// Nanoseconds a ray of each, by turn.
struct Turns {
  std::vector<double> own, built_by_embree, embree;
};

template <class Ours, class Embree>
Turns take_turns(const std::vector<AskedRay>& rays, int turns, const Rivals& rivals, const Ours& ours,
                 const Embree& embree) {
  Turns taken;
  for (int turn = 0; turn < turns; ++turn) {
    taken.own.push_back(nanoseconds(rays, [&](const AskedRay& r) { return ours(rivals.own, r); }));
    taken.embree.push_back(nanoseconds(rays, [&](const AskedRay& r) { return embree(rivals.embree, r); }));
    taken.built_by_embree.push_back(
        nanoseconds(rays, [&](const AskedRay& r) { return ours(rivals.built_by_embree, r); }));
  }
  return taken;
}

/// The share of rays whose nearest hits differ by more than rounding: those along edges, which the two may give to
/// either side.
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
  const auto nanoseconds_cell = [](const std::vector<double>& of) { return fmt::format("{:.0f}", median(of)); };
  table.row({name, kind, fmt::format("{:.0f} k", 1e-3 * static_cast<double>(rays)), nanoseconds_cell(turns.own),
             nanoseconds_cell(turns.built_by_embree), nanoseconds_cell(turns.embree),
             ratio_cell(median_ratio(turns.own, turns.embree)),
             ratio_cell(median_ratio(turns.built_by_embree, turns.embree)), apart});
}

void compare_rays(Table& table, const char* name, const RecordedRays& rays, const Rivals& rivals, int turns) {
  add_row(table, name, "nearest hit", rays.nearest.size(),
          take_turns(
              rays.nearest, turns, rivals,
              [](const Accel& accel, const AskedRay& r) { return accel.partition(r.ray, r.frames)[0].hit.t; },
              [](const BareEmbree& embree, const AskedRay& r) { return embree.nearest(r.ray); }),
          fmt::format("{:.1e}", disagreement(rays.nearest, rivals.own, rivals.embree)));
  add_row(table, name, "shadow", rays.shadow.size(),
          take_turns(
              rays.shadow, turns, rivals,
              [](const Accel& accel, const AskedRay& r) { return accel.occluded(r.ray, r.frames).empty() ? 0.f : 1.f; },
              [](const BareEmbree& embree, const AskedRay& r) { return embree.occluded(r.ray) ? 1.f : 0.f; }),
          "");
}

/// Of all triangles, and of the trees over them.
void compare_builders(Table& table, const char* name, const Scene& scene, const Rivals& rivals, int turns) {
  std::size_t primitives = 0;
  for (const PlacedShape& shape : scene.shapes) primitives += static_cast<std::size_t>(shape.shape->primitive_count());
  const auto milliseconds = [&](BvhBuilder builder) {
    const auto start = std::chrono::steady_clock::now();
    const TwoLevel tree(scene.shapes, scene.frames(), builder);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  };
  std::vector<double> own, embree;
  for (int turn = 0; turn < turns; ++turn) {
    own.push_back(milliseconds(BvhBuilder::own));
    embree.push_back(milliseconds(BvhBuilder::embree));
  }
  const auto mebibytes = [](const Accel& accel) {
    return fmt::format("{:.1f}", static_cast<double>(accel.memory()) / (1 << 20));
  };
  table.row({name, std::to_string(primitives), fmt::format("{:.1f}", median(own)),
             fmt::format("{:.1f}", median(embree)), mebibytes(rivals.own), mebibytes(rivals.built_by_embree)});
}

struct Tables {
  Table rays{{"scene", "rays", "number", "own builder, ns a ray", "Embree's builder", "Embree alone",
              "own / Embree alone", "Embree's builder / Embree alone", "hits that differ"}};
  Table builders{{"scene", "primitives", "own builder, ms", "Embree's, ms", "own, MiB", "Embree's, MiB"}};
};

void compare(Tables& tables, const char* name, const LoadedScene& loaded, const Setup& setup) {
  say("{}", name);
  const Run run = start(loaded, with_text(loaded.job, "direct", "sampled"), "sppm", {loaded.job.frames.front()});
  run.integrator->iterate({0, *run.scene});
  const Rivals rivals(*run.scene);
  compare_rays(tables.rays, name, record(run, 1, setup.quick ? 100'000 : 400'000), rivals, setup.quick ? 9 : 21);
  compare_builders(tables.builders, name, *run.scene, rivals, setup.quick ? 3 : 7);
}

}  // namespace

Findings measure_rays(const Setup& setup) {
  Tables tables;
  for (const char* name : {"glassball", "blob"})
    compare(tables, name, load(foreign(fmt::format("bench/{}.pbrt", name))), setup);
  compare(tables, "Sibenik", load_sibenik_horse(), setup);
  compare(tables, "a million triangles", load(std::filesystem::path(DSPM_SOURCE_DIR) / "bench/million.dsc"), setup);
  return {tables.rays.text() + "\nBuilding the trees, with two threads:\n\n" + tables.builders.text(), {}};
}

}  // namespace dspm
