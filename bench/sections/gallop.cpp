#include "bench/sections/gallop.h"

#include <fmt/format.h>

namespace dspm {
namespace {

constexpr int kMoments = 768;  // of the run, by which the animal's meshes are numbered

std::vector<std::string> defines(int frames, const char* estimator) {
  return {fmt::format("frames={}", frames), fmt::format("step={}", kMoments / frames),
          fmt::format("estimator={}", estimator)};
}

}  // namespace

LoadedScene load_gallop(int frames) { return load(our_scene("horse/gallop"), defines(frames, "kz11")); }

ChildReport render_gallop(int frames, const char* estimator, int iterations) {
  const auto meshes = our_scene("horse").parent_path() / "meshes";
  for (const char* file : {"hall_floor.ply", "animal.000.ply"})
    if (!std::filesystem::exists(meshes / file)) throw Skipped(fmt::format("there is no {}", file));
  std::vector<std::string> arguments = {our_scene("horse/gallop").string(), "--iterations", std::to_string(iterations)};
  for (const std::string& define : defines(frames, estimator)) arguments.insert(arguments.end(), {"-D", define});
  return run_dspm(arguments);
}

}  // namespace dspm
