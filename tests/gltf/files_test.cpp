// Every file of DSPM_TEST_DATA/data/gltf becomes a scene, but for those of broken/, which are refused.
#include <gtest/gtest.h>

#include <filesystem>

#include "dspm/session/load.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

TEST(GltfFiles, AreReadOrRefused) {
  const fs::path data = fs::path(DSPM_TEST_DATA) / "data" / "gltf";
  if (!fs::exists(data)) GTEST_SKIP() << "SKIPPED: there is no " << data;
  Choices choices;
  choices.page_fps = 2;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".glb" && file.extension() != ".gltf") continue;
    const bool is_broken = file.string().find("/broken/") != std::string::npos;
    Messages messages(true);
    std::string said;
    try {
      const LoadedScene loaded({file.string()}, choices, messages);
    } catch (const std::exception& error) {
      said = error.what();
    }
    EXPECT_EQ(!said.empty(), is_broken) << file << ": " << said;
  }
}

}  // namespace
}  // namespace dspm
