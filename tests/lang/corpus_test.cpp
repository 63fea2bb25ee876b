// Hundreds of pbrt scenes by others: every v4 one parses and survives formatting, every v3 one is read as what --upgrade
// makes of it, every older one is called by its name.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/read_file.h"
#include "dspm/lang/formatter.h"
#include "dspm/lang/upgrade.h"
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(DSPM_TEST_DATA) / "data/parse-only";

std::vector<fs::path> scenes(const std::vector<fs::path>& folders) {
  std::vector<fs::path> files;
  for (const fs::path& folder : folders)
    if (fs::is_directory(folder))
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> v4_scenes() {
  const fs::path data(DSPM_TEST_DATA);
  return scenes({kCorpus / "bitterli-v4", kCorpus / "shadeops-v4-volumes", data / "data/pbrt", data / "bench"});
}

Parsed parse_file(const fs::path& path, const std::string& text) { return parse(text, {}, path.string(), true); }

/// What the files name is not part of the corpus.
bool is_missing_file(const Diagnostic& each) { return each.message.find("there is no such file") != each.message.npos; }

void expect_same(const PluginUse& a, const PluginUse& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_TRUE(a.params.same_values(b.params));
}

template <class Use, class Compare>
void expect_same_lists(const std::vector<Use>& a, const std::vector<Use>& b, Compare compare) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) compare(a[i], b[i]);
}

void expect_same_shapes(const ShapeUse& a, const ShapeUse& b) {
  expect_same(a, b);
  EXPECT_EQ(a.world_from_object.at(Moment()), b.world_from_object.at(Moment()));
  EXPECT_EQ(a.reverse_orientation, b.reverse_orientation);
  EXPECT_EQ(a.material.index, b.material.index);
  EXPECT_EQ(a.material.name, b.material.name);
  EXPECT_EQ(a.area_light, b.area_light);
}

void expect_same_scenes(const SceneDescription& a, const SceneDescription& b) {
  const auto same_option = [](const auto& x, const auto& y) {
    ASSERT_EQ(x.has_value(), y.has_value());
    if (x) expect_same(*x, *y);
  };
  same_option(a.film, b.film);
  same_option(a.sampler, b.sampler);
  same_option(a.filter, b.filter);
  same_option(a.integrator, b.integrator);
  same_option(a.camera, b.camera);
  if (a.camera) {
    EXPECT_EQ(a.camera->camera_from_world.at(Moment()), b.camera->camera_from_world.at(Moment()));
  }
  expect_same_lists(a.materials, b.materials, [](const MaterialUse& x, const MaterialUse& y) {
    expect_same(x, y);
    EXPECT_EQ(x.name, y.name);
  });
  expect_same_lists(a.textures, b.textures, expect_same);
  expect_same_lists(a.lights, b.lights, [](const LightUse& x, const LightUse& y) {
    expect_same(x, y);
    EXPECT_EQ(x.world_from_light.at(Moment()), y.world_from_light.at(Moment()));
  });
  expect_same_lists(a.area_lights, b.area_lights, expect_same);
  expect_same_lists(a.shapes, b.shapes, expect_same_shapes);
  expect_same_lists(a.objects, b.objects, [](const ObjectDefinition& x, const ObjectDefinition& y) {
    EXPECT_EQ(x.name, y.name);
    expect_same_lists(x.shapes, y.shapes, expect_same_shapes);
  });
  EXPECT_EQ(a.instances.size(), b.instances.size());
  expect_same_lists(a.media, b.media, expect_same);
  EXPECT_EQ(a.medium_interfaces.size(), b.medium_interfaces.size());
}

TEST(Corpus, EveryV4SceneParses) {
  if (v4_scenes().empty()) GTEST_SKIP() << "no scenes under " << DSPM_TEST_DATA;
  int scenes = 0, missing = 0;
  for (const fs::path& path : v4_scenes()) {
    const std::string text = read_file(path);
    if (text.find("WorldBegin") == text.npos) continue;  // a part, which a scene includes
    ++scenes;
    const Parsed parsed = parse_file(path, text);
    const auto& all = parsed.diagnostics.all();
    missing += static_cast<int>(std::count_if(all.begin(), all.end(), is_missing_file));
    for (const Diagnostic& each : all) EXPECT_TRUE(is_missing_file(each)) << to_string(each);
    EXPECT_TRUE(parsed.scene.camera && parsed.scene.film) << path;
  }
  EXPECT_GE(scenes, 44);
  std::printf("%d scenes, %d files that they include are not there\n", scenes, missing);
}

TEST(Corpus, FormattingChangesNothing) {
  if (v4_scenes().empty()) GTEST_SKIP() << "no scenes under " << DSPM_TEST_DATA;
  for (const fs::path& path : v4_scenes()) {
    SCOPED_TRACE(path);
    const SourceFile file{path.string(), read_file(path)};
    Diagnostics diagnostics;
    const std::string once = format_scene(file, diagnostics).value();
    EXPECT_EQ(format_scene({file.name, once}, diagnostics).value(), once);
    EXPECT_EQ(std::count(once.begin(), once.end(), '#'), std::count(file.text.begin(), file.text.end(), '#'));
    expect_same_scenes(parse_file(path, file.text).scene, parse_file(path, once).scene);
  }
}

/// Without the files that it includes, which need an upgrade of their own.
std::string alone(const std::string& text) {
  std::string kept;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find("Include") == line.npos) kept += line + '\n';
  return kept;
}

bool cannot_be_translated(const Diagnostic& each) {
  return each.message.find("cannot be translated") != each.message.npos;
}

TEST(Corpus, EveryV3SceneIsTranslated) {
  const auto files = scenes({kCorpus / "pbrt-v3-scenes"});
  if (files.empty()) GTEST_SKIP() << "no scenes under " << DSPM_TEST_DATA;
  int whole = 0, refused = 0;
  for (const fs::path& path : files) {
    SCOPED_TRACE(path);
    const std::string text = read_file(path);
    if (text.find("WorldBegin") == text.npos) continue;
    ++whole;
    const Parsed parsed = parse_file(path, text);
    for (const Diagnostic& each : parsed.diagnostics.all()) {
      refused += cannot_be_translated(each);
      const bool is_warped = each.message == "ConcatTransform is not affine";  // sssdragon's matrices are transposed
      EXPECT_TRUE(is_missing_file(each) || cannot_be_translated(each) || is_warped || each.severity != Severity::error)
          << to_string(each);
    }
    EXPECT_TRUE(parsed.scene.camera && parsed.scene.film) << path;
  }
  EXPECT_GE(whole, 140);
  std::printf("%d whole scenes, %d materials and shapes that v4 does not have\n", whole, refused);
}

TEST(Corpus, UpgradeSaysInV4WhatIsReadOfV3) {
  const auto files = scenes({kCorpus / "pbrt-v3-scenes"});
  if (files.empty()) GTEST_SKIP() << "no scenes under " << DSPM_TEST_DATA;
  int compared = 0;
  for (const fs::path& path : files) {
    SCOPED_TRACE(path);
    const SourceFile file{path.string(), alone(read_file(path))};
    if (file.text.find("Film") == file.text.npos) continue;  // the sign of v3, and with "rgb" of v4
    ++compared;
    Diagnostics diagnostics(true);
    const auto upgraded = upgrade_scene(file, diagnostics);
    ASSERT_TRUE(upgraded) << to_string(diagnostics.all().front());
    EXPECT_EQ(std::count(upgraded->begin(), upgraded->end(), '#'), std::count(file.text.begin(), file.text.end(), '#'));
    const Parsed v4 = parse_file(path, *upgraded);
    for (const Diagnostic& each : v4.diagnostics.all()) EXPECT_EQ(each.message.find("pbrt-v3"), each.message.npos);
    expect_same_scenes(parse_file(path, file.text).scene, v4.scene);
  }
  EXPECT_GE(compared, 140);
}

TEST(Corpus, OlderScenesAreCalledByTheirName) {
  const auto files = scenes({kCorpus / "pbrt-v1-scenes", kCorpus / "pbrt-v2-scenes"});
  if (files.empty()) GTEST_SKIP() << "no scenes under " << DSPM_TEST_DATA;
  int whole = 0;
  for (const fs::path& path : files) {
    SCOPED_TRACE(path);
    const std::string text = read_file(path);
    const Parsed parsed = parse_file(path, text);
    if (text.find("Integrator") == text.npos && text.find("Renderer") == text.npos) continue;  // a part, or like v3
    ++whole;
    ASSERT_EQ(parsed.diagnostics.all().size(), 1u) << parsed.messages();
    EXPECT_TRUE(parsed.diagnostics.all()[0].message.starts_with("this is a scene for pbrt-v1 or v2"));
  }
  EXPECT_GE(whole, 77);
}

}  // namespace
}  // namespace dspm::test
