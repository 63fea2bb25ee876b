// The cost of a partition query, against three other ways to the same answer, on scenes that are generated here:
//   frame by frame   a query for each of the frames alone, on the same trees
//   tree per frame   the static tree once, then for each frame a tree of its own over what is there in that frame
//   restarts         WG12's scheme: the nearest hit of any frame, and again from the ray's origin for the frames left
// The ways take turns on a thousand rays at a time, and of several turns the fastest counts.
#include <algorithm>
#include <iterator>

#include "bench/measure/cpu_time.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/query_rays.h"
#include "bench/sections/sections.h"
#include "dspm/accel/two_level.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {
namespace {

volatile int g_sink;  // keeps answers from being optimised away

/// The trees that the ways need.
struct Trees {
  explicit Trees(const QueryScene& query_scene) : scene(query_scene), two_level(scene.placed, scene.all) {
    scene.all.for_each([&](Frame f) {
      const FrameSet alone = FrameSet::single(f);
      const auto there = numbers_of(scene.placed, [&](const PlacedShape& s) { return s.frames == alone; });
      of_frame.emplace_back(scene.placed, there, alone, BvhBuilder::by_size, meshes);
    });
  }

  const QueryScene& scene;
  TwoLevel two_level;
  MeshTrees meshes{BvhBuilder::by_size};
  std::vector<Tree> of_frame;
};

void partition(const Trees& trees, const Query& q) { g_sink = trees.two_level.partition(q.ray, q.frames).size(); }

void frame_by_frame(const Trees& trees, const Query& q) {
  q.frames.for_each([&](Frame f) { g_sink = trees.two_level.partition(q.ray, FrameSet::single(f)).size(); });
}

TreeRay prepared(const Trees& trees, const Ray& ray) {
  return {ray, std::max(trees.two_level.static_tree().margins(), trees.two_level.dynamic_tree().margins())};
}

void tree_a_frame(const Trees& trees, const Query& q) {
  const TreeRay ray = prepared(trees, q.ray);
  NearestHit nearest(q.frames, q.ray.t_max);
  trees.two_level.static_tree().find(ray, nearest);
  q.frames.for_each([&](Frame f) {
    NearestHit of_this_frame = nearest;
    trees.of_frame[static_cast<std::size_t>(f)].find(ray, of_this_frame);
    g_sink = of_this_frame.hit().primitive;
  });
}

void restarts(const Trees& trees, const Query& q) {
  const TreeRay ray = prepared(trees, q.ray);
  for (FrameSet rest = q.frames; !rest.empty();) {
    NearestHit nearest(rest, q.ray.t_max);
    trees.two_level.static_tree().find(ray, nearest);
    trees.two_level.dynamic_tree().find(ray, nearest);
    const RayHit hit = nearest.hit();
    g_sink = hit.primitive;
    rest -= hit.missed() ? rest : trees.scene.placed[static_cast<std::size_t>(hit.shape)].frames;
  }
}

struct Way {
  const char* name;
  void (*answer)(const Trees&, const Query&);
};
constexpr Way kWays[] = {{"Mrays/s", partition},
                         {"frame by frame", frame_by_frame},
                         {"tree per frame", tree_a_frame},
                         {"restarts", restarts}};

/// Seconds that each of the ways takes for all queries.
std::vector<double> take_turns(const Trees& trees, const std::vector<Query>& queries) {
  constexpr std::size_t kChunk = 1024;
  constexpr int kTurns = 3;
  std::vector<double> seconds(std::size(kWays), 0);
  for (std::size_t begin = 0; begin < queries.size(); begin += kChunk) {
    const std::size_t end = std::min(begin + kChunk, queries.size());
    for (std::size_t way = 0; way < seconds.size(); ++way) {
      double least = 1e9;
      for (int turn = 0; turn < kTurns; ++turn) {
        const double start = cpu_seconds();
        for (std::size_t i = begin; i < end; ++i) kWays[way].answer(trees, queries[i]);
        least = std::min(least, cpu_seconds() - start);
      }
      seconds[way] += least;
    }
  }
  return seconds;
}

void add_row(Table& table, const char* name, const char* kind, const Trees& trees, const std::vector<Query>& queries) {
  std::size_t parts = 0;
  for (const Query& q : queries) parts += static_cast<std::size_t>(trees.two_level.partition(q.ray, q.frames).size());
  const std::vector<double> seconds = take_turns(trees, queries);
  const auto count = static_cast<double>(queries.size());
  std::vector<std::string> cells = {name, std::to_string(trees.scene.all.count()), kind,
                                    ratio_cell(static_cast<double>(parts) / count),
                                    fmt::format("{:.3f}", count / seconds[0] * 1e-6)};
  for (std::size_t way = 1; way < seconds.size(); ++way) cells.push_back(ratio_cell(seconds[way] / seconds[0]));
  table.row(cells);
}

void compare(Table& table, const char* name, const QueryScene& scene) {
  const Trees trees(scene);
  say("{}, {} frames", name, scene.all.count());
  const std::vector<Query> from_camera = camera_rays(scene);
  std::vector<Query> next = bounced(scene, trees.two_level, from_camera);
  next.resize(std::min(next.size(), from_camera.size()));
  add_row(table, name, "camera", trees, from_camera);
  add_row(table, name, "bounce", trees, next);
}

}  // namespace

Findings measure_queries(const Setup& setup) {
  std::vector<std::string> head = {"scene", "K", "rays", "parts"};
  for (const Way& way : kWays) head.emplace_back(way.name);
  Table table(head);
  for (const int k : setup.quick ? std::vector<int>{16} : std::vector<int>{8, 16, 32, 64}) {
    compare(table, "water", *query_water(k));
    compare(table, "rigid body", *query_body(k, false));
    compare(table, "deforming body", *query_body(k, true));
  }
  return {table.text(), {}};
}

}  // namespace dspm
