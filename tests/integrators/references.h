// Reference pictures of our own, in tests/integrators/references: scenes of 64 x 64 pixels, and beside each the means of
// its 8 x 8 blocks with their standard errors. `path` on brute_force has converged them once, and a light tracer that
// shares no code with the integrators agrees (see make_references.cpp, which makes them anew).
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/light_tracer.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {

inline constexpr const char* kReferences[] = {"lights", "smooth", "textures", "lens", "metal", "coat", "caustic"};
inline constexpr int kReferenceSide = 64, kReferenceBlocks = 8, kReferenceDepth = 12;

inline const std::filesystem::path kReferenceFolder =
    std::filesystem::path(DSPM_SOURCE_DIR) / "tests/integrators/references";

class Reference {
 public:
  /// `options`: directives that come first.
  Reference(const std::string& name, const std::string& options)
      : file_((kReferenceFolder / (name + ".dsc")).string()), text_(options + contents(file_)) {}

  /// By the integrator that the options name.
  Tiles rendered(int iterations, int seeds) const {
    return tiles(seeds, [&](TestScene& scene, std::uint64_t seed) {
      scene.set_seed(seed);
      return scene.render_all(iterations).at(0);
    });
  }
  Tiles light_traced(std::int64_t paths, int seeds) const {
    return tiles(seeds, [&](TestScene& scene, std::uint64_t seed) {
      return LightTracer(*scene.scene({FileFrame(0)}), kReferenceSide, kReferenceSide, kReferenceDepth)
          .picture(paths, seed);
    });
  }

 private:
  template <class Render>
  Tiles tiles(int seeds, Render&& render) const {
    TestScene scene(text_, file_);
    std::vector<std::vector<Image>> renders;
    for (int seed = 1; seed <= seeds; ++seed) renders.push_back({render(scene, static_cast<std::uint64_t>(seed))});
    return tiles_of(renders, kReferenceBlocks);
  }

  std::string file_, text_;
};

inline std::filesystem::path blocks_file(const std::string& name) { return kReferenceFolder / (name + ".txt"); }

/// One line for each block, row by row, and the whole in the end: mean and standard error of red, green and blue.
inline std::string in_lines(const Tiles& blocks) {
  std::string text = fmt::format("renders {}\n", blocks.renders);
  for (std::size_t i = 0; i < blocks.means.size(); ++i)
    text += fmt::format("{:.6g} {:.2g}{}", blocks.means[i].value, std::sqrt(blocks.means[i].variance),
                        i % 3 == 2 ? "\n" : "  ");
  return text;
}

inline Tiles read_blocks(const std::string& name) {
  std::ifstream in(blocks_file(name));
  std::string word;
  Tiles blocks;
  in >> word >> blocks.renders;
  for (double mean = 0, error = 0; in >> mean >> error;) blocks.means.push_back({mean, error * error});
  if (blocks.means.size() != 3 * (kReferenceBlocks * kReferenceBlocks + 1))
    throw std::runtime_error(blocks_file(name).string() + " is not whole");
  return blocks;
}

}  // namespace dspm::test
