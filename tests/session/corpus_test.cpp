// Hundreds of pbrt scenes by others, whose meshes and pictures are not here: apart from those, all plugins and parameters
// that they name are known, or refused by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "dspm/base/system/read_file.h"
#include "dspm/session/load.h"

namespace dspm {
namespace corpus_test {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(DSPM_TEST_DATA) / "data/parse-only";

std::vector<fs::path> scenes(const std::string& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(kCorpus / folder))
    for (const auto& entry : fs::recursive_directory_iterator(kCorpus / folder))
      if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_about_data(const std::string& message) {
  for (const char* words : {"there is no ", "cannot read", "no file has that name"})
    if (message.find(words) != message.npos) return true;
  return false;
}

/// The errors that are not about missing files.
std::set<std::string> causes_in(const fs::path& path) {
  Diagnostics diagnostics;
  try {
    const LoadedScene loaded(path.string(), read_file(path), {}, diagnostics);
  } catch (const SceneError&) {}
  std::set<std::string> causes;
  for (const Diagnostic& each : diagnostics.all())
    if (each.severity == Severity::error && !is_about_data(each.message)) causes.insert(each.message);
  return causes;
}

/// By cause, how many scenes it stops; and how many nothing stops but missing data.
struct Report {
  std::map<std::string, int> stopped;
  int scenes = 0, whole = 0;
};

Report report_on(const std::string& folder) {
  Report report;
  for (const fs::path& path : scenes(folder)) {
    if (read_file(path).find("WorldBegin") == std::string::npos) continue;  // a part of a scene
    const auto causes = causes_in(path);
    ++report.scenes;
    report.whole += causes.empty();
    for (const std::string& cause : causes) ++report.stopped[cause];
  }
  for (const auto& [cause, count] : report.stopped) std::printf("%3d  %s\n", count, cause.c_str());
  std::printf("%s: %d of %d scenes lack nothing but data\n", folder.c_str(), report.whole, report.scenes);
  return report;
}

/// What dspm says that it does not have.
bool is_refused_by_name(const std::string& cause) {
  for (const char* words : {"does not render participating media", "is not supported", "cannot be translated",
                            "of material \"mix\" is an interface"})
    if (cause.find(words) != cause.npos) return true;
  return false;
}

TEST(Corpus, ScenesForV4) {
  if (scenes("bitterli-v4").empty()) GTEST_SKIP() << "no scenes under " << kCorpus;
  const Report report = report_on("bitterli-v4");
  EXPECT_GE(report.whole, 27);
  for (const auto& [cause, count] : report.stopped) EXPECT_TRUE(is_refused_by_name(cause)) << cause;
}

/// The one thing that is wrong with them: three scenes of dragons have transposed matrices.
TEST(Corpus, ScenesForV3) {
  if (scenes("pbrt-v3-scenes").empty()) GTEST_SKIP() << "no scenes under " << kCorpus;
  const Report report = report_on("pbrt-v3-scenes");
  EXPECT_GE(report.whole, 99);
  for (const auto& [cause, count] : report.stopped)
    EXPECT_TRUE(is_refused_by_name(cause) || cause == "ConcatTransform is not affine") << cause;
}

}  // namespace corpus_test
}  // namespace dspm
