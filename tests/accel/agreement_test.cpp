// Property tests: on thousands of random scenes the trees find what a loop over all primitives finds, bit by bit, and
// what they return is a partition.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "dspm/accel/brute_force.h"
#include "dspm/accel/crowd.h"
#include "dspm/accel/plain_trees.h"
#include "dspm/accel/two_level.h"
#include "tests/accel/random_scene.h"

namespace dspm {
namespace {

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

bool same(const RayHit& a, const RayHit& b) {
  return bits(a.t) == bits(b.t) && a.shape == b.shape && a.primitive == b.primitive && bits(a.uv.x) == bits(b.uv.x) &&
         bits(a.uv.y) == bits(b.uv.y);
}

bool same(const HitPartition& a, const HitPartition& b) {
  if (a.size() != b.size()) return false;
  for (int i = 0; i < a.size(); ++i)
    if (a[i].frames != b[i].frames || !same(a[i].hit, b[i].hit)) return false;
  return true;
}

std::string to_text(const HitPartition& parts) {
  std::string text;
  for (const FrameHit& part : parts)
    text += fmt::format("  {:016x}: shape {} primitive {} t {} uv {} {}\n", part.frames.bits(), part.hit.shape,
                        part.hit.primitive, part.hit.t, part.hit.uv.x, part.hit.uv.y);
  return text;
}

std::string to_text(const Ray& ray) {
  return fmt::format("origin {} {} {} direction {} {} {} t_max {}", ray.origin.x, ray.origin.y, ray.origin.z,
                     ray.direction.x, ray.direction.y, ray.direction.z, ray.t_max);
}

void expect_partition(const HitPartition& parts, FrameSet frames) {
  FrameSet seen;
  Frame lowest = -1;
  for (const FrameHit& part : parts) {
    EXPECT_FALSE(part.frames.empty());
    EXPECT_TRUE((part.frames & seen).empty());
    EXPECT_GT(part.frames.lowest(), lowest);
    for (const FrameHit& other : parts)
      EXPECT_FALSE(&part != &other && part.hit.shape == other.hit.shape && part.hit.primitive == other.hit.primitive);
    lowest = part.frames.lowest();
    seen |= part.frames;
  }
  EXPECT_EQ(seen, frames);
}

void expect_agreement(const Accel& tree, const Accel& loop, const Ray& ray, FrameSet frames) {
  const HitPartition expected = loop.partition(ray, frames), found = tree.partition(ray, frames);
  EXPECT_TRUE(same(expected, found)) << to_text(ray) << "\nexpected\n"
                                     << to_text(expected) << "found\n"
                                     << to_text(found);
  expect_partition(found, frames);
  const FrameSet blocked = loop.occluded(ray, frames), found_blocked = tree.occluded(ray, frames);
  EXPECT_EQ(blocked.bits(), found_blocked.bits()) << to_text(ray);

  FrameSet hit_frames;
  for (const FrameHit& part : found)
    if (!part.hit.missed()) hit_frames |= part.frames;
  EXPECT_EQ(hit_frames, found_blocked);
}

/// By who builds the trees of what is alike in all frames.
class Agreement : public testing::TestWithParam<BvhBuilder> {};

TEST_P(Agreement, OnRandomScenes) {
  for (std::uint64_t seed = 0; seed < 4000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene scene(seed);
    const TwoLevel tree(scene.placed(), scene.all(), GetParam());
    const BruteForce loop(scene.placed());
    for (int i = 0; i < 40; ++i) expect_agreement(tree, loop, scene.some_ray(), scene.some_frames());
  }
}

/// A plain query as an Accel.
class Plain final : public Accel {
 public:
  Plain(const TwoLevel& trees, std::span<const PlacedShape> shapes) : plain_(trees), shapes_(shapes) {}
  HitPartition partition(const Ray& ray, FrameSet frames) const override {
    return has_holes() ? plain_.query().partition(ray, frames, *this)
                       : plain_.query().partition(ray, frames, NoHoles());
  }
  FrameSet occluded(const Ray& ray, FrameSet frames) const override {
    return has_holes() ? plain_.query().occluded(ray, frames, *this) : plain_.query().occluded(ray, frames, NoHoles());
  }
  std::size_t memory() const override { return 0; }

  bool stops(int shape, const Ray& ray, int primitive, Vec2 uv) const {
    return shapes_[static_cast<std::size_t>(shape)].stops(ray, primitive, uv);
  }

 private:
  bool has_holes() const {
    return std::ranges::any_of(shapes_, [](const PlacedShape& shape) { return shape.cutout != nullptr; });
  }

  PlainTrees plain_;
  std::span<const PlacedShape> shapes_;
};

// What devices run.
TEST_P(Agreement, OfPlainQueriesOnRandomScenes) {
  int scenes = 0;
  for (std::uint64_t seed = 0; seed < 4000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene scene(seed);
    if (first_not_plain(scene.placed()) >= 0) continue;
    ++scenes;
    const TwoLevel tree(scene.placed(), scene.all(), GetParam());
    const Plain plain(tree, scene.placed());
    const BruteForce loop(scene.placed());
    for (int i = 0; i < 40; ++i) expect_agreement(plain, loop, scene.some_ray(), scene.some_frames());
  }
  EXPECT_GT(scenes, 2000);
}

// The distance of a hit is no longer within a ray that ends there, and is within one that ends at the next float.
TEST_P(Agreement, OnRaysThatEndAtAHit) {
  for (std::uint64_t seed = 10000; seed < 11000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene scene(seed);
    const TwoLevel tree(scene.placed(), scene.all(), GetParam());
    const BruteForce loop(scene.placed());
    for (int i = 0; i < 20; ++i) {
      Ray ray = scene.some_ray();
      const HitPartition parts = loop.partition(ray, scene.all());
      for (const FrameHit& part : parts) {
        if (part.hit.missed()) continue;
        for (const float end : {part.hit.t, std::nextafter(part.hit.t, kInfinity)}) {
          ray.t_max = end;
          expect_agreement(tree, loop, ray, scene.all());
        }
      }
    }
  }
}

// Frame j of a partition is what a ray that asks for frame j alone gets, from the same tree and from a tree that was
// built for frame j alone (where everything is static).
TEST_P(Agreement, OfAllFramesAndEachFrameAlone) {
  for (std::uint64_t seed = 20000; seed < 20300 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene scene(seed);
    const TwoLevel tree(scene.placed(), scene.all(), GetParam());
    std::vector<std::unique_ptr<TwoLevel>> alone;
    scene.all().for_each(
        [&](Frame f) { alone.push_back(std::make_unique<TwoLevel>(scene.placed(), FrameSet::single(f), GetParam())); });
    for (int i = 0; i < 20; ++i) {
      const Ray ray = scene.some_ray();
      for (const FrameHit& part : tree.partition(ray, scene.all())) {
        part.frames.for_each([&](Frame f) {
          const FrameSet only = FrameSet::single(f);
          EXPECT_TRUE(same(part.hit, tree.partition(ray, only)[0].hit)) << to_text(ray);
          EXPECT_TRUE(same(part.hit, alone[static_cast<std::size_t>(f)]->partition(ray, only)[0].hit)) << to_text(ray);
        });
      }
    }
  }
}

/// What moves comes last, as in scenes whose shutter is open. What is there in all frames may move as well.
std::vector<PlacedShape> with_movers(const test::RandomScene& scene, test::Random& random) {
  std::vector<PlacedShape> shapes(scene.placed().begin(), scene.placed().end());
  for (PlacedShape& shape : shapes) shape.moves = !shape.frames.contains(scene.all()) || random.below(3) == 0;
  std::stable_partition(shapes.begin(), shapes.end(), [](const PlacedShape& shape) { return !shape.moves; });
  return shapes;
}

/// A mesh of the same faces whose vertices are elsewhere.
TriangleMesh deformed(const TriangleMesh& mesh, test::Random& random) {
  MeshData data = mesh.data();
  for (Vec3& vertex : data.vertices) vertex = vertex + random.in_cube(0.3f) * (1 + max_component(abs(vertex)));
  return TriangleMesh(std::move(data));
}

/// Moves some of what moves, and leaves some of it out in some of the scenes. Meshes in the world become others, which
/// `meshes` holds.
std::vector<PlacedShape> moved(std::vector<PlacedShape> shapes, test::Random& random,
                               std::deque<TriangleMesh>& meshes) {
  if (random.below(3) == 0)
    std::erase_if(shapes, [&](const PlacedShape& shape) { return shape.moves && random.below(8) == 0; });
  for (PlacedShape& shape : shapes) {
    if (!shape.moves || random.below(4) == 0) continue;
    if (is_world_mesh(shape) && random.below(8) != 0) {
      shape.shape = &meshes.emplace_back(deformed(*shape.shape->triangles(), random));
      continue;
    }
    const PlacedShape before = shape;
    shape = test::placed(*before.shape, Transform(Matrix4::translate(random.uniform(-1, 1), random.uniform(-1, 1), 0)));
    shape.frames = before.frames, shape.cutout = before.cutout, shape.cutout_key = before.cutout_key;
    shape.moves = true;
  }
  return shapes;
}

// A tree that has what is static from another finds what a tree that is made anew finds.
TEST_P(Agreement, WithWhatIsStaticFromATreeAtAnotherTime) {
  int with_static = 0;
  for (std::uint64_t seed = 30000; seed < 31000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::RandomScene scene(seed);
    test::Random random(seed);
    std::deque<TriangleMesh> meshes;
    const std::vector<PlacedShape> shapes = with_movers(scene, random), later = moved(shapes, random, meshes);
    const TwoLevel tree(shapes, scene.all(), GetParam());
    const std::unique_ptr<Accel> other = tree.with(later, scene.all());
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(&static_cast<const TwoLevel&>(*other).static_tree(), &tree.static_tree());
    const BruteForce loop(later);
    for (int i = 0; i < 40; ++i) expect_agreement(*other, loop, scene.some_ray(), scene.some_frames());
    if (shapes.empty() || shapes.front().moves) continue;
    ++with_static;
    std::vector<PlacedShape> elsewhere = shapes;
    elsewhere.front().to_world = Transform(Matrix4::translate(3, 0, 0));
    EXPECT_EQ(tree.with(elsewhere, scene.all()), nullptr);
    elsewhere = shapes;
    elsewhere.erase(elsewhere.begin());
    EXPECT_EQ(tree.with(elsewhere, scene.all()), nullptr) << "the numbers of shapes are others";
  }
  EXPECT_GT(with_static, 100);
}

// Thousands of triangles in one mesh, so that a builder uses all its threads.
TEST_P(Agreement, OnALargeMesh) {
  test::Random random(7);
  MeshData data;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 at = random.in_cube(1);
    for (int corner = 0; corner < 3; ++corner) data.vertices.push_back(at + random.in_cube(0.02f));
    data.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const TriangleMesh mesh(std::move(data));
  std::vector<PlacedShape> placed = {test::placed(mesh, {}),
                                     test::placed(mesh, Transform(Matrix4::rotate(30, 0, 1, 0)))};
  const FrameSet all = FrameSet::first(2);
  for (PlacedShape& each : placed) each.frames = all;
  const TwoLevel tree(placed, all, GetParam());
  const BruteForce loop(placed);
  for (int i = 0; i < 300; ++i) expect_agreement(tree, loop, {random.in_cube(2), random.direction()}, all);
}

// So many triangles of a sequence that many threads cut them into pieces, and build what is below a node.
TEST_P(Agreement, OnALargeDeformingMesh) {
  test::Random random(9);
  constexpr int kFrames = 4;
  std::vector<MeshData> data(kFrames);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 at = random.in_cube(1), way = random.in_cube(i % 2 == 0 ? 0.01f : 0.3f);
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 beside = random.in_cube(0.03f);
      for (int f = 0; f < kFrames; ++f)
        data[static_cast<std::size_t>(f)].vertices.push_back(at + beside + static_cast<float>(f) * way);
    }
    for (MeshData& mesh : data) mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  std::vector<std::unique_ptr<TriangleMesh>> meshes;
  std::vector<PlacedShape> placed;
  for (int f = 0; f < kFrames; ++f) {
    meshes.push_back(std::make_unique<TriangleMesh>(std::move(data[static_cast<std::size_t>(f)])));
    placed.push_back(test::placed(*meshes.back(), {}));
    placed.back().frames = FrameSet::single(f);
  }
  const FrameSet all = FrameSet::first(kFrames);
  const TwoLevel tree(placed, all, GetParam());
  const BruteForce loop(placed);
  for (int i = 0; i < 200; ++i)
    expect_agreement(tree, loop, {random.in_cube(2), random.direction()},
                     i % 2 == 0 ? all : FrameSet::single(i / 2 % 4));
}

// So many pieces that they get nodes at once, in trees of all kinds.
TEST_P(Agreement, OnHair) {
  test::Random random(8);
  const auto hair = [&](float width) {
    std::vector<CurveSegment> segments;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 at = random.in_cube(1), along = 0.1f * random.direction(), bent = 0.1f * random.direction();
      segments.push_back(CurveSegment::of({at, at + along, at + 2 * along + bent, at + 3 * along + bent}, width, 0));
    }
    Curves curves(CurveType::cylinder, segments, {}, 3);
    curves.settle();
    EXPECT_TRUE(is_crowd(curves));
    return curves;
  };
  const Curves thin = hair(0.001f), thick = hair(0.01f);
  const test::Stripes stripes;
  const Transform turned(Matrix4::rotate(30, 0, 1, 0));
  const FrameSet all = FrameSet::first(3);
  std::vector<PlacedShape> placed;
  const auto place = [&](const Shape& shape, const Transform& to_world, FrameSet frames) -> PlacedShape& {
    placed.push_back(test::placed(shape, to_world));
    placed.back().frames = frames;
    return placed.back();
  };
  place(thin, {}, all);
  place(thick, {}, all).cutout = &stripes;
  place(thin, turned, all);
  place(thick, {}, FrameSet::single(0));
  place(thin, {}, FrameSet(6));
  place(thick, turned, FrameSet::single(2));
  const TwoLevel tree(placed, all, GetParam());
  const TwoLevel alone(std::span<const PlacedShape>(placed).first(1), all, GetParam());
  EXPECT_LT(alone.memory(), 50u * static_cast<std::size_t>(thin.primitive_count()));  // without such nodes 70
  const BruteForce loop(placed);
  for (int i = 0; i < 50; ++i) expect_agreement(tree, loop, {random.in_cube(2), random.direction()}, all);
}

// So many patches that they get nodes at once.
TEST_P(Agreement, OnPatches) {
  test::Random random(10);
  constexpr int kSide = 130;
  const auto hills = [&](float height) {
    std::vector<Vec3> vertices;
    std::vector<int> indices;
    for (int y = 0; y <= kSide; ++y)
      for (int x = 0; x <= kSide; ++x)
        vertices.push_back(
            {static_cast<float>(x) / kSide - 0.5f, random.uniform(0, height), static_cast<float>(y) / kSide - 0.5f});
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int v = y * (kSide + 1) + x;
        indices.insert(indices.end(), {v, v + 1, v + kSide + 1, v + kSide + 2});
      }
    return test::bilinear_mesh(vertices, std::move(indices));
  };
  const std::unique_ptr<Shape> low = hills(0.05f), high = hills(0.2f);
  EXPECT_TRUE(is_crowd(*low));
  const test::Stripes stripes;
  const Transform turned(Matrix4::rotate(30, 0, 1, 1));
  const FrameSet all = FrameSet::first(3);
  std::vector<PlacedShape> placed;
  const auto place = [&](const Shape& shape, const Transform& to_world, FrameSet frames) -> PlacedShape& {
    placed.push_back(test::placed(shape, to_world));
    placed.back().frames = frames, placed.back().cutout_key = placed.size();
    return placed.back();
  };
  place(*low, {}, all);
  place(*high, {}, all).cutout = &stripes;
  place(*low, turned, all).cutout = &stripes;
  place(*high, {}, FrameSet::single(0)).cutout = &stripes;
  place(*low, turned, FrameSet::single(2));
  const TwoLevel tree(placed, all, GetParam());
  const BruteForce loop(placed);
  const Plain plain(tree, placed);
  for (int i = 0; i < 50; ++i) {
    const Vec3 origin = random.in_cube(1), target = random.in_cube(0.5f);
    const Ray ray{origin, normalize(target - origin)};
    expect_agreement(tree, loop, ray, all);
    expect_agreement(plain, loop, ray, all);
  }
}

// What is not a number goes nowhere; in a tree it would enter every box.
TEST_P(Agreement, OnRaysThatAreNotNumbers) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  test::RandomScene scene(3);
  const TwoLevel tree(scene.placed(), scene.all(), GetParam());
  for (const Vec3& broken : {Vec3{kNan, kNan, kNan}, Vec3{kNan, 1, 0}, Vec3{0, kNan, 1}, Vec3{1, 0, kNan}})
    for (const Ray& ray : {Ray{{0, 0, 0}, broken}, Ray{broken, {0, 0, 1}}}) {
      for (const FrameHit& part : tree.partition(ray, scene.all())) EXPECT_TRUE(part.hit.missed());
      EXPECT_TRUE(tree.occluded(ray, scene.all()).empty());
    }
}

TEST_P(Agreement, OnNothing) {
  const TwoLevel tree({}, FrameSet::first(64), GetParam());
  const Ray ray{{0, 0, 0}, {0, 0, 1}};
  const HitPartition parts = tree.partition(ray, FrameSet(5));
  ASSERT_EQ(parts.size(), 1);
  EXPECT_EQ(parts[0].frames, FrameSet(5));
  EXPECT_TRUE(parts[0].hit.missed());
  EXPECT_EQ(tree.partition(ray, FrameSet()).size(), 0);
  EXPECT_TRUE(tree.occluded(ray, FrameSet(5)).empty());
}

INSTANTIATE_TEST_SUITE_P(Builders, Agreement, testing::Values(BvhBuilder::own, BvhBuilder::embree),
                         [](const auto& builder) { return builder.param == BvhBuilder::own ? "Own" : "Embree"; });

}  // namespace
}  // namespace dspm
