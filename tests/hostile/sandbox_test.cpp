// With --sandbox nothing outside of the directory is read or written, by whatever name it is called, and no plugin is
// loaded; within it everything works as without.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "dspm/image/png.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* kObj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";

/// box/ is what the scene may touch; the same files lie beside it.
class Sandbox : public testing::Test {
 protected:
  Sandbox() {
    for (const char* folder : {"", "box/"}) {
      fs::create_directories(directory / folder);
      put(folder + std::string("part.dsc"), "Shape \"sphere\"\n");
      put(folder + std::string("a.ply"), kPly);
      put(folder + std::string("a.obj"), kObj);
      put(folder + std::string("a.mtl"), "newmtl red\nKd 1 0 0\nmap_Kd a.png\n");
      put(folder + std::string("a.spd"), "400 1 700 2\n");
      write_png(directory / (folder + std::string("a.png")), Image(4, 4));
    }
    fs::create_symlink("..", directory / "box/up");
    fs::create_symlink("../a.png", directory / "box/link.png");
    fs::create_symlink("../not-there-yet.exr", directory / "box/dangling.0001.exr");
    fs::create_symlink("../a.mtl", directory / "box/linked.mtl");
    put("box/linked.obj", "mtllib linked.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    put("box/named.obj", "mtllib textured.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    put("box/textured.mtl", "newmtl m\nmap_Kd ../a.png\n");
  }

  void put(const std::string& name, const std::string& text) { put_file(directory / name, text); }

  /// The tiny scene with that in its world.
  Outcome render(const std::string& world, std::vector<std::string> options = {}) {
    put("box/scene.dsc", kTinyScene + world);
    options.insert(options.end(), {"box/scene.dsc", "--sandbox", "box", "--quiet", "--iterations", "1"});
    if (std::find(options.begin(), options.end(), "-o") == options.end()) {
      options.insert(options.end(), {"-o", "box/image.####.exr"});
    }
    return run(directory, options);
  }
  std::string refusal() const { return "lies outside the sandbox " + (fs::canonical(directory / "box")).string(); }

  void expect_refused(const Outcome& outcome, const std::string& what) const {
    EXPECT_EQ(outcome.code, 1) << what << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(refusal()), std::string::npos) << what << "\n" << outcome.err;
  }

  TemporaryDirectory directory;
};

/// `{}` is where the file's name goes.
const std::pair<const char*, const char*> kReads[] = {
    {"Include \"{}\"\n", "part.dsc"},
    {"Import \"{}\"\n", "part.dsc"},
    {"Shape \"plymesh\" \"string filename\" \"{}\"\n", "a.ply"},
    {"Shape \"objmesh\" \"string filename\" \"{}\"\n", "a.obj"},
    {"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{}\"\nMaterial \"diffuse\" \"texture reflectance\" "
     "\"t\" Shape \"sphere\"\n",
     "a.png"},
    {"LightSource \"infinite\" \"string filename\" \"{}\"\n", "a.png"},
    {"Material \"conductor\" \"spectrum eta\" \"{}\" Shape \"sphere\"\n", "a.spd"},
};

TEST_F(Sandbox, FilesWithinAreReadAndWritten) {
  std::string world;
  for (const auto& [directive, file] : kReads) world += fmt::format(fmt::runtime(directive), file);
  const Outcome outcome = render(world, {"--png", "--contact-sheet", "box/sheet.png", "--stats=box/stats.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"box/image.0001.exr", "box/image.0003.png", "box/sheet.png", "box/stats.json"})
    EXPECT_TRUE(fs::exists(directory / name)) << name;
}

TEST_F(Sandbox, NamesThatLeadOutsideAreNotRead) {
  for (const auto& [directive, file] : kReads) {
    const std::string absolute = fs::canonical(directory / file).string();
    for (const std::string& name :
         {"../" + std::string(file), "up/" + std::string(file), absolute, "./../box/../" + std::string(file)}) {
      const std::string world = fmt::format(fmt::runtime(directive), name);
      const Outcome outcome = render(world);
      expect_refused(outcome, world);
      EXPECT_NE(outcome.err.find("scene.dsc:"), std::string::npos) << outcome.err;
    }
  }
}

TEST_F(Sandbox, NothingIsLearntOfWhatLiesOutside) {
  const std::string there = render("Include \"../part.dsc\"").err, not_there = render("Include \"../none.dsc\"").err;
  std::string renamed = not_there;
  for (std::size_t at; (at = renamed.find("none")) != renamed.npos;) renamed.replace(at, 4, "part");
  EXPECT_EQ(renamed, there);
}

TEST_F(Sandbox, LinksAreResolved) {
  expect_refused(render("LightSource \"infinite\" \"string filename\" \"link.png\""), "a linked picture");
  expect_refused(render("Shape \"objmesh\" \"string filename\" \"linked.obj\""), "linked materials");
  expect_refused(render("Shape \"objmesh\" \"string filename\" \"named.obj\""), "a texture of materials");
  fs::create_symlink("a.png", directory / "box/inside.png");
  EXPECT_EQ(render("LightSource \"infinite\" \"string filename\" \"inside.png\"").code, 0);
}

TEST_F(Sandbox, NothingIsWrittenOutside) {
  const std::vector<std::vector<std::string>> cases = {
      {"-o", "image.####.exr"},        {"-o", "box/up/image.####.exr"},  {"-o", "/tmp/image.####.exr"},
      {"-o", "box/../image.####.exr"}, {"--contact-sheet", "sheet.png"}, {"--contact-sheet", "box/up/sheet.png"},
      {"--stats=stats.json"},          {"--stats=box/../stats.json"},    {"-o", "box/dangling.####.exr"},
      {"--video", "film.mp4"},         {"--checkpoint", "night.ck"},     {"--resume", "night.ck"}};
  for (const char* stream : {"out.txt", "err.txt"}) put(stream, "");
  for (const std::vector<std::string>& options : cases) {
    const int before = directory.file_count();
    expect_refused(render("", options), options.back());
    EXPECT_EQ(directory.file_count(), before) << options.back();
  }
}

TEST_F(Sandbox, TheSceneItselfLiesWithin) {
  expect_refused(run(directory, {"part.dsc", "--sandbox", "box"}), "the main file");
  expect_refused(run(directory, {"part.dsc", "--sandbox", "box", "--format"}), "a file to format");
  expect_refused(run(directory, {"--new-plugin", "shape", "a", "new", "--sandbox", "box"}), "a new plugin");
  for (const char* folder : {"box/none/../up/evil", "box/none/../../evil"})
    expect_refused(run(directory, {"--new-plugin", "shape", "a", folder, "--sandbox", "box"}), folder);
  EXPECT_FALSE(fs::exists(directory / "evil") || fs::exists(directory / "box/none"));
  EXPECT_FALSE(fs::exists(directory / "new"));
}

TEST_F(Sandbox, LoadsNoPlugins) {
  const Outcome directive = render("Plugin \"any.so\"");
  EXPECT_EQ(directive.code, 1);
  EXPECT_NE(directive.err.find("--sandbox loads no plugins"), std::string::npos) << directive.err;
  const Outcome option = render("", {"--plugin", "any.so"});
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.err.find("--sandbox loads no plugins"), std::string::npos) << option.err;
  setenv("DSPM_PLUGIN_PATH", (directory / "box").c_str(), 1);
  const Outcome variable = render("");
  unsetenv("DSPM_PLUGIN_PATH");
  EXPECT_EQ(variable.code, 2);
  EXPECT_NE(variable.err.find("DSPM_PLUGIN_PATH"), std::string::npos) << variable.err;
}

TEST_F(Sandbox, PipesAndDevicesAreNotRead) {
  ASSERT_EQ(mkfifo((directory / "box/pipe.dsc").c_str(), 0600), 0);
  const Outcome outcome = render("Include \"pipe.dsc\"");  // would wait for ever
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("it is not a regular file"), std::string::npos) << outcome.err;
}

TEST_F(Sandbox, NoFolderIsMadeOutside) {
  put("box/lamp.gltf",
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
          "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},
          "nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],"scenes":[{"nodes":[0]}]})");
  for (const char* out : {"out/a.dsc", "box/../out/a.dsc", "box/up/out/a.dsc"}) {
    const Outcome outcome = run(directory, {"--to-dsc", "box/lamp.gltf", "-o", out, "--sandbox", "box"});
    expect_refused(outcome, out);
    EXPECT_FALSE(fs::exists(directory / "out")) << out;
  }
}

TEST_F(Sandbox, MustBeADirectory) {
  const Outcome outcome = run(directory, {"box/part.dsc", "--sandbox", "nowhere"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "dspm: --sandbox nowhere: there is no directory nowhere\n");
}

}  // namespace
}  // namespace dspm::test
