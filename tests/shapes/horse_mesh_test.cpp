// Mending the horse, whose 24 frames have the same holes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "dspm/shapes/mesh_check.h"
#include "dspm/shapes/mesh_repair.h"
#include "dspm/shapes/mesh_topology.h"
#include "dspm/shapes/obj.h"
#include "tests/shapes/meshes.h"

namespace dspm {
namespace {

// 24 frames of a galloping horse, 19 open edges in each: one plan closes all of them.
TEST(HorseMesh, IsMendedInAllFrames) {
  const std::filesystem::path data = std::filesystem::path(DSPM_TEST_DATA) / "data/horse-gallop";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "there is no " << data;
  const auto frame = [&](int i) {
    return TriangleMesh(read_obj(data / fmt::format("{:04}.obj", i), "", false).meshes.at(0).mesh);
  };
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point a, Clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
  };

  const TriangleMesh first = frame(1);
  const auto t0 = Clock::now();
  const MeshReport report = check_mesh(first);
  const auto t1 = Clock::now();
  const RepairPlan plan = plan_repair(first);
  const auto t2 = Clock::now();
  for (const std::string& s : describe(report)) std::cout << s << '\n';
  for (const std::string& s : describe(plan)) std::cout << s << '\n';
  std::cout << fmt::format("check {:.3f} s, plan {:.3f} s\n", seconds(t0, t1), seconds(t1, t2));
  EXPECT_EQ(report.open_edges.count, 19);
  for (int i = 1; i <= 24; ++i) {
    const TriangleMesh mended = apply(plan, frame(i));
    const std::vector<Edge> edges = edges_of(replace_vertices(mended.faces(), weld(mended.vertices())));
    EXPECT_TRUE(
        std::all_of(edges.begin(), edges.end(), [](const Edge& e) { return e.forward == 1 && e.backward == 1; }));
    EXPECT_GT(test::volume(mended), 0) << i;
    EXPECT_EQ(mended.faces(), plan.faces);
    if (i % 8 != 0) continue;
    const MeshReport after = check_mesh(mended);
    EXPECT_TRUE(after.closed() && after.outward && after.orientable && after.twisted_edges.count == 0) << i;
  }
}

}  // namespace
}  // namespace dspm
