// How fast triangle data in a scene's text is read, in bytes a second on one core. The goal is 50 MB/s.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "lang/formatter.h"
#include "lang/parse.h"

namespace {

/// A wavy grid of side * side squares as `Shape "trianglemesh"`, numbers as exporters write them.
std::string mesh_text(int side) {
  std::string text = "WorldBegin\nShape \"trianglemesh\"\n  \"point3 P\" [";
  const auto out = std::back_inserter(text);
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", x * 0.01, std::sin(x * 0.1) * std::cos(y * 0.13), y * 0.01);
  text += "]\n  \"integer indices\" [";
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
      fmt::format_to(out, "{} {} {} {} {} {}\n", a, b, c, b, d, c);
    }
  return text + "]\n";
}

void check(benchmark::State& state, const dspm::Diagnostics& diagnostics) {
  if (diagnostics.error_count() > 0) state.SkipWithError("the text does not parse");
}

void parse_mesh(benchmark::State& state) {
  const std::string text = mesh_text(500);
  for (auto _ : state) {
    dspm::Diagnostics diagnostics;
    benchmark::DoNotOptimize(dspm::parse_text("mesh.dsc", text, {}, diagnostics));
    check(state, diagnostics);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(parse_mesh)->Unit(benchmark::kMillisecond);

/// Many short directives instead of few long lists.
void parse_directives(benchmark::State& state) {
  std::string text = "WorldBegin\nMakeNamedMaterial \"wood\" \"string type\" \"diffuse\"\n";
  for (int i = 0; i < 20000; ++i)
    fmt::format_to(std::back_inserter(text),
                   "AttributeBegin\n  Translate {} 0 1\n  Rotate {} 0 1 0\n  NamedMaterial \"wood\"\n"
                   "  Shape \"sphere\" \"float radius\" [ 0.{} ]\nAttributeEnd\n",
                   i, i % 360, i + 1);
  for (auto _ : state) {
    dspm::Diagnostics diagnostics;
    benchmark::DoNotOptimize(dspm::parse_text("spheres.dsc", text, {}, diagnostics));
    check(state, diagnostics);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(parse_directives)->Unit(benchmark::kMillisecond);

void format_mesh(benchmark::State& state) {
  const dspm::SourceFile file{"mesh.dsc", mesh_text(500)};
  for (auto _ : state) {
    dspm::Diagnostics diagnostics;
    benchmark::DoNotOptimize(dspm::format_scene(file, diagnostics));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.text.size()));
}
BENCHMARK(format_mesh)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
