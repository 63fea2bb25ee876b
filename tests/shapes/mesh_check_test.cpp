// What is wrong with meshes, and mending them: each fault alone, and all at once.
#include "dspm/shapes/mesh_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/shapes/mesh_repair.h"
#include "tests/shapes/meshes.h"
#include "tests/shapes/random.h"

namespace dspm {
namespace {

using test::volume;

std::string faults(const MeshData& data) {
  std::string text;
  for (const std::string& s : describe(check_mesh(TriangleMesh(data)))) text += s + "\n";
  return text;
}

MeshData joined(const MeshData& a, const MeshData& b) {
  MeshData both = a;
  const int shift = static_cast<int>(a.vertices.size());
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Face& f : b.faces) both.faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  return both;
}

void turn_over(MeshData& data) {
  for (Face& f : data.faces) std::swap(f[1], f[2]);
}

/// A vertex of its own for every corner.
MeshData torn(const MeshData& data) {
  MeshData result;
  for (const Face& f : data.faces) {
    Face& face = result.faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      face[i] = static_cast<int>(result.vertices.size());
      result.vertices.push_back(data.vertices[static_cast<std::size_t>(f[i])]);
    }
  }
  return result;
}

TEST(MeshCheck, SoundMeshesHaveNoFaults) {
  EXPECT_EQ(faults(test::box(1, {})), "");
  EXPECT_EQ(faults(test::icosphere(3, 0.01f, {100, 0, 0})), "");
  EXPECT_EQ(faults(torn(test::box(1, {}))), "");
  EXPECT_EQ(check_mesh(TriangleMesh(torn(test::box(1, {})))).duplicate_vertices, 36 - 8);
}

TEST(MeshCheck, HolesAreFound) {
  MeshData data = test::box(1, {3, 0, 0});
  data.faces.pop_back();  // half the upper side: its first edge lies at x = 2, z = 1
  EXPECT_EQ(faults(data), "it is not closed but has 1 hole: 3 open edges, the first near (2, 0, 1)\n");
  data = test::icosphere(3, 1, {});
  data.faces.erase(data.faces.begin() + 7);
  data.faces.erase(data.faces.begin() + 300);
  EXPECT_EQ(check_mesh(TriangleMesh(data)).holes, 2);
}

TEST(MeshCheck, SidesAreFound) {
  MeshData data = test::icosphere(1, 1, {});
  turn_over(data);
  EXPECT_EQ(faults(data), "it is inside out, or some of its components are\n");
  data = test::box(1, {});
  std::swap(data.faces[4][0], data.faces[4][1]);
  EXPECT_EQ(check_mesh(TriangleMesh(data)).twisted_edges.count, 3);
  // A hollow body: the inner surface must be turned towards the hollow.
  MeshData inner = test::icosphere(1, 0.3f, {});
  EXPECT_FALSE(check_mesh(TriangleMesh(joined(test::box(1, {}), inner))).outward);
  turn_over(inner);
  EXPECT_TRUE(check_mesh(TriangleMesh(joined(test::box(1, {}), inner))).sound());
}

TEST(MeshCheck, MoebiusStripsHaveOneSide) {
  MeshData strip;
  const int n = 24;
  for (int i = 0; i < n; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / n, r = std::cos(a / 2) * 0.3f, z = std::sin(a / 2) * 0.3f;
    for (const float s : {-1.f, 1.f})
      strip.vertices.push_back({(1 + s * r) * std::cos(a), (1 + s * r) * std::sin(a), s * z});
  }
  for (int i = 0; i < n; ++i) {
    const bool last = i == n - 1;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.faces.insert(strip.faces.end(), {{a, b, c}, {b, d, c}});
  }
  const MeshReport report = check_mesh(TriangleMesh(strip));
  EXPECT_FALSE(report.orientable);
  EXPECT_EQ(report.holes, 1);
  EXPECT_TRUE(check_mesh(TriangleMesh(test::box(1, {}))).orientable);
}

TEST(MeshCheck, SelfIntersectionsAreFound) {
  const MeshReport report = check_mesh(TriangleMesh(joined(test::box(1, {}), test::box(1, {0.9f, 0.8f, 0.7f}))));
  EXPECT_GT(report.self_intersections.count, 5);
  EXPECT_FALSE(report.sound());
  EXPECT_EQ(check_mesh(TriangleMesh(joined(test::box(1, {}), test::box(1, {3, 0, 0})))).self_intersections.count, 0);
}

TEST(MeshCheck, CrowdedEdgesAndFlatFacesAreFound) {
  MeshData data = test::box(1, {});
  data.vertices.push_back({0, 0, 5});
  data.faces.push_back({0, 1, 8});  // a fin
  const MeshReport fin = check_mesh(TriangleMesh(data));
  EXPECT_EQ(fin.crowded_edges.count, 1);
  EXPECT_EQ(fin.crowded_edges.where, (Vec3{0, -1, -1}));
  data = test::box(1, {});
  data.vertices.push_back(data.vertices[0]);
  data.faces.push_back({0, 8, 1});
  EXPECT_EQ(check_mesh(TriangleMesh(data)).flat_faces.count, 1);
  EXPECT_TRUE(check_mesh(TriangleMesh(data)).sound());
}

/// Repairs and expects a sound mesh of that volume.
RepairPlan expect_mended(const MeshData& data, double expected_volume) {
  const TriangleMesh mesh(data);
  const RepairPlan plan = plan_repair(mesh);
  const TriangleMesh mended = apply(plan, mesh);
  EXPECT_TRUE(check_mesh(mended).sound()) << faults({mended.vertices(), {}, {}, mended.faces()});
  EXPECT_NEAR(volume(mended), expected_volume, 1e-5 * expected_volume);
  EXPECT_EQ(plan.open_edges, 0);
  return plan;
}

TEST(MeshRepair, SoundMeshesStay) {
  const TriangleMesh sphere(test::icosphere(2, 1, {}));
  const RepairPlan plan = plan_repair(sphere);
  EXPECT_FALSE(plan.changes());
  EXPECT_EQ(plan.faces, sphere.faces());
  EXPECT_TRUE(describe(plan).empty());
}

TEST(MeshRepair, SmallHolesAreFilledAndLargeOnesAreNot) {
  MeshData data = test::icosphere(3, 1, {});
  const double whole = volume(TriangleMesh(data));
  data.faces.erase(data.faces.begin() + 100);
  EXPECT_EQ(expect_mended(data, whole).new_faces, 1);

  MeshData open = test::box(1, {});
  open.faces.resize(10);  // a side is missing
  const RepairPlan plan = plan_repair(TriangleMesh(open));
  EXPECT_EQ(plan.new_faces, 0);
  EXPECT_EQ(plan.open_edges, 4);
  EXPECT_EQ(describe(plan).back(), "4 open edges remain");
}

TEST(MeshRepair, SidesAreTurnedOutwards) {
  MeshData data = test::icosphere(2, 1, {});
  const double whole = volume(TriangleMesh(data));
  test::Random random(41);
  int turned = 0;
  for (Face& f : data.faces)
    if (random.below(3) == 0) std::swap(f[0], f[2]), ++turned;
  EXPECT_EQ(expect_mended(data, whole).turned_faces, turned);
  turn_over(data);
  EXPECT_EQ(expect_mended(data, whole).turned_faces, static_cast<int>(data.faces.size()) - turned);
}

TEST(MeshRepair, CracksAreClosed) {
  MeshData data = torn(test::icosphere(2, 1, {}));
  test::Random random(42);
  for (Vec3& v : data.vertices) v += random.in_cube(3e-7f);
  const TriangleMesh mesh(data);
  EXPECT_GT(check_mesh(mesh).open_edges.count, 100);
  const TriangleMesh mended = apply(plan_repair(mesh), mesh);
  EXPECT_TRUE(check_mesh(mended).closed());
  EXPECT_EQ(mended.vertices().size(), data.vertices.size());
}

TEST(MeshRepair, NormalsAndTextureSeamsSurvive) {
  MeshData data = torn(test::icosphere(2, 1, {}));
  for (const Vec3& v : data.vertices) data.normals.push_back(-v), data.uvs.push_back({v.x, v.y});
  const double whole = -volume(TriangleMesh(data));  // its normals have turned it inside out
  EXPECT_GT(whole, 0);
  const RepairPlan plan = expect_mended(data, whole);
  const TriangleMesh mended = apply(plan, TriangleMesh(data));
  for (std::size_t i = 0; i < data.vertices.size(); ++i) {
    EXPECT_GT(dot(mended.normals()[i], data.vertices[i]), 0.99f);
    EXPECT_EQ(mended.uvs()[i], data.uvs[i]);
  }
}

TEST(MeshRepair, RepeatedFacesAreDropped) {
  MeshData data = test::box(1, {});
  data.faces.push_back(data.faces[3]);
  data.faces.push_back({0, 0, 1});
  EXPECT_EQ(expect_mended(data, 8).dropped_faces, 2);
}

TEST(MeshRepair, PlansFitTheirMeshOnly) {
  const RepairPlan plan = plan_repair(TriangleMesh(test::box(1, {})));
  EXPECT_TRUE(fits(plan, TriangleMesh(test::box(2, {1, 1, 1}))));
  EXPECT_FALSE(fits(plan, TriangleMesh(test::icosphere(0, 1, {}))));
  EXPECT_THROW(apply(plan, TriangleMesh(test::icosphere(0, 1, {}))), std::invalid_argument);
}

}  // namespace
}  // namespace dspm
