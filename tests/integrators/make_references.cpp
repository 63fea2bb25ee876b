// Makes the blocks of tests/integrators/references anew, all or those of the scenes named; some minutes each:
//
//   build/release/tests/integrators/make_references [scene...]
//
// What `path` on brute_force and the light tracer do not agree on is not written.
#include <cstdio>
#include <set>

#include "tests/integrators/references.h"

using namespace dspm::test;

namespace {

constexpr int kSeeds = 16;

struct Effort {
  const char* scene;
  int iterations;            // of `path`, a seed
  std::int64_t light_paths;  // a seed
};
// Blocks then have a standard error of 0.2 to 0.5% by `path`, and of 0.5 to 1% by light tracing.
constexpr Effort kEfforts[] = {{"lights", 256, 2'000'000}, {"smooth", 64, 200'000}, {"textures", 480, 2'000'000},
                               {"lens", 96, 800'000},      {"metal", 144, 800'000}, {"coat", 128, 150'000},
                               {"caustic", 384, 400'000}};
static_assert(std::size(kEfforts) == std::size(kReferences));

double mean_error(const Tiles& blocks) {
  double sum = 0;
  for (const Tiles::Mean& mean : blocks.means) sum += std::sqrt(mean.variance) / mean.value;
  return sum / static_cast<double>(blocks.means.size());
}

bool make(const Effort& effort) {
  const std::string name = effort.scene;
  const Tiles blocks = Reference(name, fmt::format("Accelerator \"bruteforce\"\n"
                                                   "Integrator \"path\" \"integer maxdepth\" {}\n",
                                                   kReferenceDepth))
                           .rendered(effort.iterations, kSeeds);
  const Tiles other = Reference(name, "").light_traced(effort.light_paths, kSeeds);
  const Verdict verdict = agreement(blocks, other, {0.01 / std::size(kReferences), 0});
  std::printf("%s: %s; mean relative standard error: path %.2f%%, light tracer %.2f%%\n", effort.scene,
              verdict.message.c_str(), 100 * mean_error(blocks), 100 * mean_error(other));
  std::fflush(stdout);
  if (verdict.passed) put_file(blocks_file(name), in_lines(blocks));
  return verdict.passed;
}

}  // namespace

int main(int count, char** arguments) {
  const std::set<std::string> chosen(arguments + 1, arguments + count);
  bool all = true;
  for (const Effort& effort : kEfforts)
    if (chosen.empty() || chosen.contains(effort.scene)) all &= make(effort);
  return all ? 0 : 1;
}
