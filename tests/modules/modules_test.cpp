// What an author of a module meets: where modules are found, what is said of those that cannot be used, and how dspm
// gets along with those that misbehave.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/modules/mischief.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace modules_test {

const std::string kModules = DSPM_TEST_MODULES;
std::string module_file(const std::string& name) { return kModules + "/lib" + name + ".so"; }

/// DSPM_PLUGIN_PATH as long as it lives.
class PluginPath {
 public:
  explicit PluginPath(const std::string& path) { setenv("DSPM_PLUGIN_PATH", path.c_str(), 1); }
  ~PluginPath() { unsetenv("DSPM_PLUGIN_PATH"); }
  PluginPath(const PluginPath&) = delete;
  PluginPath& operator=(const PluginPath&) = delete;
};

std::string scene_with(const std::string& integrator) {
  return tiny_scene(
      "Integrator \"dsppm\" \"string indirect\" \"photons\" \"integer iterations\" 2 \"integer photons\" 200 \"integer "
      "seed\" 5",
      integrator);
}

std::string plugin_directive(const std::string& file) { return std::string("Plugin \"").append(file).append("\""); }

TEST(Modules, TheCommandLineNamesThem) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc", "--integrator", "mischief"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_paintings(directory);
}

TEST(Modules, ASceneNamesThemBesideItself) {
  const TinyDirectory directory;
  std::filesystem::create_directory(directory / "plugins");
  std::filesystem::copy(module_file("mischief"), directory / "plugins");
  put_file(directory / "tiny.dsc", scene_with("Plugin \"plugins/libmischief.so\" Integrator \"mischief\""));
  const Outcome outcome = run(directory, {"tiny.dsc"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_paintings(directory);
}

TEST(Modules, AFolderOfThemMayBeSet) {
  const TinyDirectory directory;
  std::filesystem::create_directory(directory / "plugins");
  std::filesystem::copy(module_file("mischief"), directory / "plugins");
  const PluginPath path(std::string(":").append(directory / "plugins"));
  EXPECT_EQ(run(directory, {"tiny.dsc", "--integrator", "mischief"}).code, 0);
  expect_paintings(directory);
  put_file(directory / "tiny.dsc",
           scene_with("Plugin \"libmischief.so\" Integrator \"mischief\" \"string mood\" \"nan\""));
  EXPECT_EQ(run(directory, {"tiny.dsc"}).code, 0);
}

TEST(Modules, AFolderThatIsNotThereIsToldOf) {
  const TinyDirectory directory;
  const PluginPath path("/nowhere/at/all");
  const Outcome outcome = run(directory, {"--list"});
  EXPECT_EQ(outcome.code, 2);
  expect_contains(outcome.err, "DSPM_PLUGIN_PATH: /nowhere/at/all: No such file or directory");
}

TEST(Modules, OneFileIsLoadedOnce) {
  const TinyDirectory directory;
  std::filesystem::create_symlink(module_file("mischief"), directory / "other.so");
  put_file(directory / "tiny.dsc", scene_with("Plugin \"other.so\" Plugin \"./other.so\" Integrator \"mischief\""));
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Modules, ListsTellTheOrigin) {
  const TinyDirectory directory;
  const std::string list = run(directory, {"--plugin", module_file("mischief"), "--list"}).out;
  expect_contains(list, "  mischief             libmischief.so  does what a bad integrator may do\n");
  expect_contains(list, "  photonmap            dspm            ");
  const std::string description =
      run(directory, {"--plugin", module_file("mischief"), "--describe", "integrator:mischief"}).out;
  expect_contains(description, "integrator:mischief (libmischief.so): does what");
  expect_contains(description, "what it does (good, throw,");
}

struct Unfit {
  std::string name;
  std::vector<std::string> said;
};

TEST(Modules, UnfitOnesAreToldAndNothingRuns) {
  const std::vector<Unfit> all = {
      {"other_version", {"libother_version.so: it was built for dspm 7.3.0, and this is dspm 0.3.0", "rebuild it"}},
      {"other_layout", {"dspm::SurfacePoint takes", "rebuild it"}},
      {"usurper", {"dspm itself already has the material \"diffuse\""}},
      {"idle", {"it adds no plugin"}},
      {"thrower", {"libthrower.so: no licence for dspm 0.3.0"}},
      {"missing", {"No such file or directory"}},
  };
  for (const Unfit& unfit : all) {
    const TinyDirectory directory;
    setenv("DSPM_TEST_TRACE", (directory / "trace").c_str(), 1);
    const Outcome by_option = run(directory, {"--plugin", module_file(unfit.name), "tiny.dsc"});
    EXPECT_EQ(by_option.code, 2) << unfit.name;
    for (const std::string& part : unfit.said) expect_contains(by_option.err, part);
    EXPECT_FALSE(directory.has("tiny.0001.exr")) << unfit.name;
    EXPECT_FALSE(directory.has("trace")) << "its static constructor has run";

    if (unfit.name == "missing") continue;
    put_file(directory / "tiny.dsc", plugin_directive(module_file(unfit.name)) + kTinyScene);
    const Outcome by_scene = run(directory, {"tiny.dsc"});
    EXPECT_EQ(by_scene.code, 1) << unfit.name;
    expect_contains(by_scene.err, "tiny.dsc:1:8");
    for (const std::string& part : unfit.said) expect_contains(by_scene.err, part);
  }
  unsetenv("DSPM_TEST_TRACE");
}

TEST(Modules, WhatIsNoModuleIsTold) {
  const TinyDirectory directory;
  put_file(directory / "text.so", "no library");
  expect_contains(run(directory, {"--plugin", "text.so", "--list"}).err, "text.so: it is not a shared library");
  expect_contains(run(directory, {"--plugin", "missing.so", "--list"}).err, "missing.so: No such file or directory");
  ASSERT_EQ(mkfifo((directory / "pipe.so").c_str(), 0600), 0);
  expect_contains(run(directory, {"--plugin", "pipe.so", "--list"}).err, "pipe.so: it is not a regular file");
  put_file(directory / "tiny.dsc", plugin_directive("missing.so") + kTinyScene);
  const Outcome outcome = run(directory, {"tiny.dsc"});
  EXPECT_EQ(outcome.code, 1);
  expect_contains(outcome.err, "tiny.dsc:1:8: error: there is no module \"missing.so\"");
}

TEST(Modules, ANameBelongsToOne) {
  const TinyDirectory directory;
  const Outcome outcome =
      run(directory, {"--plugin", module_file("mischief"), "--plugin", module_file("twin"), "--list"});
  EXPECT_EQ(outcome.code, 2);
  expect_contains(outcome.err, "libtwin.so: libmischief.so already has the integrator \"mischief\"");
}

TEST(Modules, WhatOneThrowsIsItsErrorAndImagesAreKept) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene_with("Integrator \"mischief\" \"string mood\" \"throw\""));
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc"});
  EXPECT_EQ(outcome.code, 1);
  expect_contains(outcome.err, "integrator \"mischief\" of libmischief.so threw: out of paint");
  expect_paintings(directory);
}

TEST(Modules, OneThatTakesAllMemoryIsNamedAndImagesAreKept) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes more address space than there is";
#endif
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene_with("Integrator \"mischief\" \"string mood\" \"hoard\""));
  const Outcome outcome =
      Process(directory, {"--plugin", module_file("mischief"), "tiny.dsc"}, "out.txt", "err.txt", [] {
        const rlimit limit{300'000'000, 300'000'000};
        setrlimit(RLIMIT_AS, &limit);
      }).wait();
  EXPECT_EQ(outcome.code, 1);
  expect_contains(
      outcome.err,
      "out of memory: iteration 3 (in integrator \"mischief\" of libmischief.so) needs more than is available, after ");
  expect_contains(outcome.err, " of the 300.0 MB that ulimit -v allows");
  expect_paintings(directory);
}

TEST(Modules, WhatAFactoryThrowsIsItsErrorToo) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene_with("Integrator \"mischief\" \"string mood\" \"refuse\""));
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc"});
  EXPECT_EQ(outcome.code, 1);
  expect_contains(outcome.err, "integrator \"mischief\" of libmischief.so threw: not today");
}

TEST(Modules, NoNanReachesAFile) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene_with("Integrator \"mischief\" \"string mood\" \"nan\""));
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  expect_contains(outcome.err,
                  "integrator \"mischief\" of libmischief.so: radiance of frame 3 has 2 pixels that cannot be shown "
                  "(negative, NaN or infinite), the first at x = 3, y = 1");
  const Image image = read_image(directory / "tiny.0003.exr");
  EXPECT_EQ(image.at(3, 1), Rgb(0));
  EXPECT_EQ(image.at(4, 1), Rgb(0.75f));
}

TEST(Modules, OneThatDoesNotComeBackIsNamed) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene_with("Integrator \"mischief\" \"string mood\" \"hang\""));
  const Outcome outcome = run(directory, {"--plugin", module_file("mischief"), "tiny.dsc", "--patience", "1s"});
  EXPECT_EQ(outcome.code, 0);
  expect_contains(outcome.err, "iteration 3 has not ended after ");
  expect_contains(outcome.err, "at work: integrator \"mischief\" of libmischief.so");
}

}  // namespace modules_test
}  // namespace dspm::test
