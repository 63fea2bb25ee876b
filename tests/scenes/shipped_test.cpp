// The scenes in scenes/ are sound, with the meshes that the generator makes for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/session/load.h"
#include "scenes/generator/subjects.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace shipped_test {

namespace fs = std::filesystem;

class Warnings : public Messages {
 public:
  Warnings() : Messages(true) {}
  const std::string& text() const { return text_; }

 protected:
  void print(std::string_view text) const override { text_ += text; }

 private:
  mutable std::string text_;
};

class ShippedScenes : public ::testing::Test {
 protected:
  /// A copy of scenes/ with all meshes.
  static void SetUpTestSuite() {
    copy_ = std::make_unique<test::TemporaryDirectory>();
    fs::copy(fs::path(DSPM_SOURCE_DIR) / "scenes", scenes(), fs::copy_options::recursive);
    fs::remove_all(scenes() / "meshes");
    fs::create_directory(scenes() / "meshes");
    for (const Subject& subject : subjects()) subject.make(scenes() / "meshes");
  }
  static void TearDownTestSuite() { copy_.reset(); }

  static fs::path scenes() { return *copy_ / "scenes"; }
  static std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".dsc") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }
  /// Loads a scene and expects neither errors nor warnings, but for that of drink.dsc, which shows what it is about.
  static void expect_sound(const fs::path& scene, const std::vector<std::string>& defines = {}) {
    Choices choices;
    choices.defines = defines;
    Warnings warnings;
    try {
      const LoadedScene loaded({scene.string()}, choices, warnings);
    } catch (const SceneError& error) {
      ADD_FAILURE() << scene << "\n" << error.what();
    }
    const bool may_warn = scene.filename() == "drink.dsc";
    EXPECT_TRUE(may_warn || warnings.text().empty()) << scene << "\n" << warnings.text();
  }

 private:
  static inline std::unique_ptr<test::TemporaryDirectory> copy_;
};

TEST_F(ShippedScenes, AreSound) {
  const std::vector<fs::path> files = files_in(scenes());
  EXPECT_GE(files.size(), 5u);
  for (const fs::path& file : files) expect_sound(file);
}

TEST_F(ShippedScenes, OfTheGalleryAreSound) {
  const std::vector<fs::path> files = files_in(scenes() / "gallery");
  EXPECT_GE(files.size(), 2u);
  for (const fs::path& file : files) expect_sound(file);
}

TEST_F(ShippedScenes, AreNineOfFigure9) {
  const std::vector<fs::path> files = files_in(scenes() / "figure9");
  EXPECT_EQ(files.size(), 9u);
  for (const fs::path& file : files) expect_sound(file);
}

TEST_F(ShippedScenes, HorseGallopsInAnyNumberOfFrames) {
  for (const int frames : {1, 24, 256})
    expect_sound(scenes() / "horse/gallop.dsc",
                 {"frames=" + std::to_string(frames), "step=" + std::to_string(768 / frames), "estimator=hj09"});
}

}  // namespace shipped_test
}  // namespace dspm
