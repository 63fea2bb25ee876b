// How fast scenes' text and meshes are read, and meshes checked and repaired, on one core.
#include <cmath>
#include <iterator>

#include "bench/measure/cpu_time.h"
#include "bench/measure/run.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/query_scenes.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/lang/formatter.h"
#include "dspm/lang/parse.h"
#include "dspm/shapes/mesh_check.h"
#include "dspm/shapes/mesh_repair.h"
#include "dspm/shapes/obj.h"
#include "dspm/shapes/ply.h"

namespace dspm {
namespace {

MeshData wavy_grid(int side) {
  return surface(side, [](float u, float v) { return Vec3{5 * u, std::sin(50 * u) * std::cos(65 * v), 5 * v}; });
}

// ---- Text ----

/// As exporters write a mesh into a scene.
std::string scene_with(const MeshData& mesh) {
  std::string text = "WorldBegin\nShape \"trianglemesh\"\n  \"point3 P\" [";
  const auto out = std::back_inserter(text);
  for (const Vec3& p : mesh.vertices) fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
  text += "]\n  \"integer indices\" [";
  for (const auto& face : mesh.faces) fmt::format_to(out, "{} {} {}\n", face[0], face[1], face[2]);
  return text + "]\n";
}

/// Many short directives instead of few long lists.
std::string scene_of_spheres(int count) {
  std::string text = "WorldBegin\nMakeNamedMaterial \"wood\" \"string type\" \"diffuse\"\n";
  for (int i = 0; i < count; ++i)
    fmt::format_to(std::back_inserter(text),
                   "AttributeBegin\n  Translate {} 0 1\n  Rotate {} 0 1 0\n  NamedMaterial \"wood\"\n"
                   "  Shape \"sphere\" \"float radius\" [ 0.{} ]\nAttributeEnd\n",
                   i, i % 360, i + 1);
  return text;
}

std::string ply_header(const MeshData& mesh, const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.vertices.size(), mesh.faces.size());
}

std::string ascii_ply(const MeshData& mesh) {
  std::string text = ply_header(mesh, "ascii");
  const auto out = std::back_inserter(text);
  for (const Vec3& p : mesh.vertices) fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", p.x, p.y, p.z);
  for (const auto& face : mesh.faces) fmt::format_to(out, "3 {} {} {}\n", face[0], face[1], face[2]);
  return text;
}

std::string binary_ply(const MeshData& mesh) {
  std::string bytes = ply_header(mesh, "binary_little_endian");
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const Vec3& p : mesh.vertices) put(p);
  for (const auto& face : mesh.faces) bytes += '\3', put(face);
  return bytes;
}

void parse(const std::string& text) {
  Diagnostics diagnostics;
  parse_text("mesh.dsc", text, {}, diagnostics);
  diagnostics.throw_if_errors();
}

void format(const std::string& text) {
  Diagnostics diagnostics;
  format_scene({"mesh.dsc", text}, diagnostics);
  diagnostics.throw_if_errors();
}

// ---- Measuring ----

/// The median of several times.
template <class Work>
double seconds_of(const Work& work) {
  constexpr int kTimes = 9;
  std::vector<double> seconds;
  for (int i = 0; i < kTimes; ++i) {
    const double begin = cpu_seconds();
    work();
    seconds.push_back(cpu_seconds() - begin);
  }
  return median(seconds);
}

template <class Work>
void add_text_row(Table& table, const char* what, const std::string& text, const Work& work) {
  say("{}", what);
  const double seconds = seconds_of([&] { work(text); });
  table.row({what, fmt::format("{:.1f}", static_cast<double>(text.size()) / 1e6), fmt::format("{:.0f}", 1e3 * seconds),
             fmt::format("{:.0f}", static_cast<double>(text.size()) / 1e6 / seconds)});
}

std::string text_table(int side) {
  const MeshData mesh = wavy_grid(side);
  Table table({"what", "MB", "ms", "MB/s"});
  add_text_row(table, "parsing triangle data in a scene's text", scene_with(mesh), parse);
  add_text_row(table, "parsing short directives", scene_of_spheres(20000), parse);
  add_text_row(table, "formatting triangle data", scene_with(mesh), format);
  add_text_row(table, "reading PLY, ASCII", ascii_ply(mesh), [](const std::string& file) { read_ply(file); });
  add_text_row(table, "reading PLY, binary", binary_ply(mesh), [](const std::string& file) { read_ply(file); });
  return table.text();
}

std::string mesh_line() {
  const std::filesystem::path file = foreign("data/horse-gallop/0001.obj");
  const auto read = [&] { return TriangleMesh(read_obj(file, "", false).meshes.at(0).mesh); };
  const TriangleMesh mesh = read();
  const double reading = seconds_of(read), checking = seconds_of([&] { check_mesh(mesh); });
  const double repairing = seconds_of([&] { apply(plan_repair(mesh), mesh); });
  return fmt::format("The paper's horse is read in {:.0f} ms, checked in {:.0f} ms, repaired in {:.0f} ms.\n",
                     1e3 * reading, 1e3 * checking, 1e3 * repairing);
}

}  // namespace

Findings measure_reading(const Setup& setup) {
  const ThreadLimit one(1);
  std::string text = text_table(setup.quick ? 200 : 500);
  try {
    text += fmt::format("\n{}", mesh_line());
  } catch (const Skipped& why) {
    text += fmt::format("\nThe paper's horse: SKIPPED, {}\n", why.what());
  }
  return {text, {}};
}

}  // namespace dspm
