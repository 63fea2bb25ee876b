// The scenes in scenes/ are sound: nothing is wrong with them but meshes that have not been made.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/load.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(DSPM_SOURCE_DIR) / "scenes";

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".dsc") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Errors, but those about files in scenes/meshes.
std::vector<std::string> errors_of(const std::vector<fs::path>& scene, const std::vector<std::string>& defines = {}) {
  Options options;
  options.scenes.assign(scene.begin(), scene.end());
  options.defines = defines;
  Messages messages(true);
  std::vector<std::string> errors;
  try {
    const LoadedScene loaded(options, messages);
  } catch (const SceneError& error) {
    std::istringstream text(error.what());
    for (std::string line; std::getline(text, line);)
      if (line.find(": error: ") != line.npos &&
          (line.find("there is no file \"") == line.npos || line.find("meshes/") == line.npos))
        errors.push_back(line);
  }
  return errors;
}

TEST(ShippedScenes, AreSound) {
  const std::vector<fs::path> files = files_in(kScenes);
  EXPECT_GE(files.size(), 5u);
  for (const fs::path& file : files) EXPECT_EQ(errors_of({file}), std::vector<std::string>{}) << file;
}

TEST(ShippedScenes, AreNineOfFigure9) {
  const std::vector<fs::path> files = files_in(kScenes / "figure9");
  EXPECT_EQ(files.size(), 9u);
  for (const fs::path& file : files) EXPECT_EQ(errors_of({file}), std::vector<std::string>{}) << file;
}

TEST(ShippedScenes, HorseGallopsInAnyNumberOfFrames) {
  for (const int frames : {1, 8, 16, 24, 32, 64, 256}) {
    const std::vector<std::string> defines{"frames=" + std::to_string(frames), "step=" + std::to_string(768 / frames),
                                           "estimator=hj09"};
    EXPECT_EQ(errors_of({kScenes / "horse/gallop.dsc"}, defines), std::vector<std::string>{}) << frames;
  }
}

}  // namespace
}  // namespace dspm
