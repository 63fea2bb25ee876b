#include "bench/sections/query_scenes.h"

#include <cmath>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {

void QueryScene::add(TriangleMesh mesh, FrameSet frames) {
  shapes.push_back(std::make_unique<TriangleMesh>(std::move(mesh)));
  place(*shapes.back(), Transform(), frames);
}

void QueryScene::place(const Shape& shape, const Transform& to_world, FrameSet frames) {
  placed.push_back(
      {.shape = &shape, .to_world = to_world, .frames = frames, .to_world_is_identity = to_world.is_identity()});
}

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

std::unique_ptr<QueryScene> query_water(int frame_count) {
  auto scene = std::make_unique<QueryScene>();
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

namespace {

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
void add_hall(QueryScene& scene) {
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

}  // namespace

std::unique_ptr<QueryScene> query_body(int frame_count, bool deforming) {
  auto scene = std::make_unique<QueryScene>();
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

}  // namespace dspm
