// Mesh files in bytes a second, and the check and repair of a mesh, on one core.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "shapes/mesh_check.h"
#include "shapes/mesh_repair.h"
#include "shapes/obj.h"
#include "shapes/ply.h"

namespace {

using namespace dspm;

constexpr int kSide = 500;  // a wavy grid of 250,000 squares

Vec3 grid_point(int i) {
  const auto x = static_cast<float>(i % (kSide + 1)), y = static_cast<float>(i / (kSide + 1));
  return {x * 0.01f, std::sin(x * 0.1f) * std::cos(y * 0.13f), y * 0.01f};
}

std::string ply_header(const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, (kSide + 1) * (kSide + 1), kSide * kSide);
}

template <class Fn>
void for_each_square(const Fn& fn) {
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x;
      fn(a, a + 1, a + kSide + 2, a + kSide + 1);
    }
}

std::string ascii_ply() {
  std::string text = ply_header("ascii");
  for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) {
    const Vec3 p = grid_point(i);
    text += fmt::format("{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
  }
  for_each_square([&](int a, int b, int c, int d) { text += fmt::format("4 {} {} {} {}\n", a, b, c, d); });
  return text;
}

std::string binary_ply() {
  std::string bytes = ply_header("binary_little_endian");
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) put(grid_point(i));
  for_each_square([&](int a, int b, int c, int d) { bytes += '\4', put(a), put(b), put(c), put(d); });
  return bytes;
}

void read(benchmark::State& state, const std::string& file) {
  for (auto _ : state) benchmark::DoNotOptimize(read_ply(file));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.size()));
}
void read_ascii_ply(benchmark::State& state) { read(state, ascii_ply()); }
void read_binary_ply(benchmark::State& state) { read(state, binary_ply()); }
BENCHMARK(read_ascii_ply)->Unit(benchmark::kMillisecond);
BENCHMARK(read_binary_ply)->Unit(benchmark::kMillisecond);

const std::filesystem::path kHorse = std::filesystem::path(DSPM_TEST_DATA) / "data/horse-gallop/0001.obj";

TriangleMesh horse(benchmark::State& state) {
  if (std::filesystem::exists(kHorse)) return TriangleMesh(read_obj(kHorse, "", false).parts.at(0).mesh);
  state.SkipWithError("the horse is not there");
  return TriangleMesh(MeshData{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}});
}

void read_horse_obj(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(horse(state));
}
void check_horse(benchmark::State& state) {
  const TriangleMesh mesh = horse(state);
  for (auto _ : state) benchmark::DoNotOptimize(check_mesh(mesh));
}
void repair_horse(benchmark::State& state) {
  const TriangleMesh mesh = horse(state);
  for (auto _ : state) benchmark::DoNotOptimize(apply(plan_repair(mesh), mesh));
}
BENCHMARK(read_horse_obj)->Unit(benchmark::kMillisecond);
BENCHMARK(check_horse)->Unit(benchmark::kMillisecond);
BENCHMARK(repair_horse)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
