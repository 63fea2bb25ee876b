// What a partition query costs, against three other ways to the same answer, on scenes that are generated here:
//   frame by frame   a query for each of the frames alone, on the same trees
//   tree a frame     the static tree once, then for each frame a tree of its own over what is there in that frame
//   restarts         WG12's scheme: the nearest hit of any frame, and again from the ray's origin for the frames left
// The ways take turns on a thousand rays at a time, and of several turns the fastest counts.
//
//   accel_bench [K ...]       by default 8 16 32 64
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <functional>

#include "accel/two_level.h"
#include "core/rng.h"
#include "shapes/triangle_mesh.h"

namespace dspm {
namespace {

// ---- Scenes ----

/// A surface over [0, 1]^2 in `n` by `n` quads.
MeshData surface(int n, const std::function<Vec3(float u, float v)>& at) {
  MeshData mesh;
  const auto step = 1 / static_cast<float>(n);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.push_back(at(static_cast<float>(i) * step, static_cast<float>(j) * step));
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      mesh.faces.insert(mesh.faces.end(), {{a, a + 1, b}, {a + 1, b + 1, b}});
    }
  }
  return mesh;
}

struct Scene {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<PlacedShape> placed;
  FrameSet all;
  Vec3 eye, look_at;

  void add(MeshData mesh, FrameSet frames) { add(TriangleMesh(std::move(mesh)), frames); }
  void add(TriangleMesh mesh, FrameSet frames) {
    shapes.push_back(std::make_unique<TriangleMesh>(std::move(mesh)));
    place(*shapes.back(), Transform(), frames);
  }
  void place(const Shape& shape, const Transform& to_world, FrameSet frames) {
    placed.push_back(
        {.shape = &shape, .to_world = to_world, .frames = frames, .to_world_is_identity = to_world.is_identity()});
  }
};

/// 20K triangles of waves that move a little every frame, over the bottom of a pool.
std::unique_ptr<Scene> water(int frame_count) {
  auto scene = std::make_unique<Scene>();
  scene->all = FrameSet::first(frame_count);
  scene->eye = {0, 1.6f, -2.2f}, scene->look_at = {0, 0, 0};
  scene->add(surface(30, [](float u, float v) { return Vec3{4 * u - 2, -0.6f, 4 * v - 2}; }), scene->all);
  for (Frame f = 0; f < frame_count; ++f) {
    const float time = 0.05f * static_cast<float>(f);
    const auto height = [&](float x, float z) {
      return 0.05f * std::sin(5 * x + 3 * z - 4 * time) + 0.03f * std::sin(11 * z - 7 * x + 5 * time);
    };
    scene->add(surface(100,
                       [&](float u, float v) {
                         const float x = 3 * u - 1.5f, z = 3 * v - 1.5f;
                         return Vec3{x, height(x, z), z};
                       }),
               FrameSet::single(f));
  }
  return scene;
}

/// A lumpy ball of 10K triangles; `time` deforms it.
MeshData body(float time) {
  return surface(71, [&](float u, float v) {
    const float theta = kPi * v, phi = 2 * kPi * u;
    const float r =
        0.5f + 0.1f * std::sin(3 * phi + time) * std::sin(4 * theta) + 0.02f * std::sin(20 * phi + 9 * theta);
    return Vec3{0.5f * r * std::sin(theta) * std::cos(phi), r * std::cos(theta), r * std::sin(theta) * std::sin(phi)};
  });
}

/// 80K triangles: a floor, and two rows of columns.
void add_hall(Scene& scene) {
  scene.eye = {-3, 1.7f, -1.2f}, scene.look_at = {1, 0.8f, 0.1f};
  scene.add(surface(100,
                    [](float u, float v) {
                      return Vec3{10 * u - 5, 0.01f * std::sin(90 * u) * std::sin(70 * v), 4 * v - 2};
                    }),
            scene.all);
  for (int c = 0; c < 20; ++c) {
    const Vec3 foot{static_cast<float>(c / 2) - 4.5f, 0, c % 2 == 0 ? -1.6f : 1.6f};
    scene.add(surface(39,
                      [&](float u, float v) {
                        const float r = 0.15f + 0.02f * std::cos(32 * kPi * u) + 0.1f * std::exp(-20 * v),
                                    phi = 2 * kPi * u;
                        return foot + Vec3{r * std::cos(phi), 3 * v, r * std::sin(phi)};
                      }),
              scene.all);
  }
}

std::unique_ptr<Scene> running_body(int frame_count, bool deforming) {
  auto scene = std::make_unique<Scene>();
  scene->all = FrameSet::first(frame_count);
  add_hall(*scene);
  if (!deforming) scene->shapes.push_back(std::make_unique<TriangleMesh>(body(0)));
  const Shape& rigid = *scene->shapes.back();
  for (Frame f = 0; f < frame_count; ++f) {
    const float share = static_cast<float>(f) / static_cast<float>(frame_count);
    const Matrix4 at =
        Matrix4::translate(4 * share - 1.5f, 0.8f, 0.2f * std::sin(6 * share)) * Matrix4::rotate(200 * share, 0, 1, 0);
    if (deforming) {
      scene->add(TriangleMesh(body(9 * share)).transformed(Transform(at)), FrameSet::single(f));
    } else {
      scene->place(rigid, Transform(at), FrameSet::single(f));
    }
  }
  return scene;
}

// ---- Rays ----

struct Query {
  Ray ray;
  FrameSet frames;
};

constexpr int kResolution = 128;

std::vector<Query> camera_rays(const Scene& scene) {
  std::vector<Query> queries;
  const Vec3 forward = normalize(scene.look_at - scene.eye), right = normalize(cross({0, 1, 0}, forward));
  const Vec3 up = cross(forward, right);
  for (int y = 0; y < kResolution; ++y) {
    for (int x = 0; x < kResolution; ++x) {
      const float sx = (static_cast<float>(x) + 0.5f) / kResolution - 0.5f;
      const float sy = 0.5f - (static_cast<float>(y) + 0.5f) / kResolution;
      queries.push_back({{scene.eye, normalize(forward + right * sx + up * sy)}, scene.all});
    }
  }
  return queries;
}

/// One diffuse bounce from everything that `queries` meet, in the frames that meet it.
std::vector<Query> bounced(const Scene& scene, const Accel& accel, const std::vector<Query>& queries) {
  std::vector<Query> next;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const PathRandom random(1, Stream::camera, i, 0);
    for (const FrameHit& part : accel.partition(queries[i].ray, queries[i].frames)) {
      if (part.hit.missed()) continue;
      const PlacedShape& placed = scene.placed[static_cast<std::size_t>(part.hit.shape)];
      const SurfacePoint s = placed.surface_point(part.hit.primitive, part.hit.uv);
      const Vec2 u = random.pair(0, 0);
      const float z = std::sqrt(u.x), r = std::sqrt(1 - u.x), phi = 2 * kPi * u.y;
      const Vec3 n = dot(s.ng, queries[i].ray.direction) > 0 ? -s.ng : s.ng;
      next.push_back({s.spawn(Basis::around(n).to_world({r * std::cos(phi), r * std::sin(phi), z})), part.frames});
    }
  }
  return next;
}

// ---- Measuring ----

using Answer = std::function<void(const Query&)>;

double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds that each of the ways takes for all queries.
std::vector<double> take_turns(const std::vector<Query>& queries, const std::vector<Answer>& ways) {
  constexpr std::size_t kChunk = 1024;
  constexpr int kTurns = 3;
  std::vector<double> seconds(ways.size(), 0);
  for (std::size_t begin = 0; begin < queries.size(); begin += kChunk) {
    const std::size_t end = std::min(begin + kChunk, queries.size());
    std::vector<double> least(ways.size(), 1e9);
    for (std::size_t way = 0; way < ways.size(); ++way) {
      for (int turn = 0; turn < kTurns; ++turn) {
        const double start = now();
        for (std::size_t i = begin; i < end; ++i) ways[way](queries[i]);
        least[way] = std::min(least[way], now() - start);
      }
    }
    for (std::size_t way = 0; way < ways.size(); ++way) seconds[way] += least[way];
  }
  return seconds;
}

volatile int g_sink;  // keeps answers from being optimised away

void restart(const Tree& still, const Tree& moving, const Scene& scene, const Query& query) {
  for (FrameSet rest = query.frames; !rest.empty();) {
    NearestHit nearest(rest, query.ray.t_max);
    still.find(query.ray, nearest);
    moving.find(query.ray, nearest);
    const RayHit hit = nearest.hit();
    g_sink = hit.primitive;
    rest -= hit.missed() ? rest : scene.placed[static_cast<std::size_t>(hit.shape)].frames;
  }
}

void compare(const char* name, const Scene& scene) {
  const TwoLevel tree(scene.placed, scene.all);
  const Tree& still = tree.static_tree();
  const Tree& moving = tree.dynamic_tree();
  MeshTrees meshes;
  std::vector<Tree> of_frame;
  scene.all.for_each([&](Frame f) {
    const auto there = numbers_of(scene.placed, [&](const PlacedShape& s) { return s.frames == FrameSet::single(f); });
    of_frame.emplace_back(scene.placed, there, FrameSet::single(f), meshes);
  });

  const std::vector<Answer> ways{
      [&](const Query& q) { g_sink = tree.partition(q.ray, q.frames).size(); },
      [&](const Query& q) {
        q.frames.for_each([&](Frame f) { g_sink = tree.partition(q.ray, FrameSet::single(f)).size(); });
      },
      [&](const Query& q) {
        NearestHit nearest(q.frames, q.ray.t_max);
        still.find(q.ray, nearest);
        q.frames.for_each([&](Frame f) {
          NearestHit of_this_frame = nearest;
          of_frame[static_cast<std::size_t>(f)].find(q.ray, of_this_frame);
          g_sink = of_this_frame.hit().primitive;
        });
      },
      [&](const Query& q) { restart(still, moving, scene, q); },
  };
  std::vector<Query> queries = camera_rays(scene);
  for (const char* kind : {"camera", "bounce"}) {
    std::size_t frames = 0, parts = 0;
    for (const Query& q : queries) {
      frames += static_cast<std::size_t>(q.frames.count());
      parts += static_cast<std::size_t>(tree.partition(q.ray, q.frames).size());
    }
    const std::vector<double> seconds = take_turns(queries, ways);
    const auto count = static_cast<double>(queries.size());
    fmt::print("{:<16} {:>2} {} {:>6.1f} {:>6.2f} {:>8.3f} {:>15.2f} {:>13.2f} {:>9.2f}\n", name, scene.all.count(),
               kind, static_cast<double>(frames) / count, static_cast<double>(parts) / count, count / seconds[0] * 1e-6,
               seconds[1] / seconds[0], seconds[2] / seconds[0], seconds[3] / seconds[0]);
    queries = bounced(scene, tree, queries);
    if (queries.size() > kResolution * kResolution) queries.resize(kResolution * kResolution);
  }
}

}  // namespace
}  // namespace dspm

int main(int argc, char** argv) {
  std::vector<int> counts;
  for (int i = 1; i < argc; ++i) counts.push_back(std::atoi(argv[i]));
  if (counts.empty()) counts = {8, 16, 32, 64};
  fmt::print("Partition queries per second, and how many times longer the other ways take\n");
  fmt::print("{:<16} {:>2} {:<6} {:>6} {:>6} {:>8} {:>15} {:>13} {:>9}\n", "scene", "K", "rays", "frames", "parts",
             "Mrays/s", "frame by frame", "tree a frame", "restarts");
  for (const int k : counts) {
    dspm::compare("water", *dspm::water(k));
    dspm::compare("rigid body", *dspm::running_body(k, false));
    dspm::compare("deforming body", *dspm::running_body(k, true));
  }
}
