// The galloping animal must be glass in every frame: closed, consistently oriented, nowhere through itself.
#include "scenes/generator/animal.h"

#include <gtest/gtest.h>

#include "dspm/shapes/mesh_check.h"
#include "tests/support/seeds.h"

namespace dspm::animal {
namespace animal_test {

TEST(Animal, IsSoundAndOnTheGroundInEveryPose) {
  const Body body = make_body();
  const int poses = test::seeds(8);
  bool stands = false;
  for (int i = 0; i < poses; ++i) {
    const MeshData mesh = posed(body, gallop(static_cast<float>(i) / static_cast<float>(poses)));
    const MeshReport report = check_mesh(TriangleMesh(mesh));
    EXPECT_TRUE(report.sound()) << "pose " << i << ": " << describe(report).front();
    Bounds3 bounds;
    for (const Vec3& p : mesh.vertices) bounds.add(p);
    EXPECT_GT(bounds.low.y, -0.02f) << "pose " << i;
    stands = stands || bounds.low.y < 0.02f;
    EXPECT_LT(bounds.high.y, 2.4f);
  }
  EXPECT_TRUE(stands);
}

TEST(Animal, IsFineEnough) {
  const std::size_t faces = make_body().mesh.faces.size();
  EXPECT_GT(faces, 9000u);
  EXPECT_LT(faces, 11000u);
}

}  // namespace animal_test
}  // namespace dspm::animal
