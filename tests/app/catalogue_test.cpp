// What --list and --describe print: lines in columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "dspm/app/tasks/tasks.h"
#include "dspm/base/params/errors.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {
namespace {

// Kinds stand at the margin; below them name, origin and sentence, each column as wide as its widest entry.
TEST(Catalogue, ListsPluginsInColumns) {
  const std::vector<CatalogueEntry> plugins = all_plugins();
  std::size_t names = 0;
  for (const CatalogueEntry& plugin : plugins) names = std::max(names, plugin.name.size());
  std::size_t found = 0;
  std::istringstream lines(list_plugins());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ")) continue;
    const CatalogueEntry& plugin = plugins.at(found++);
    EXPECT_EQ(line.find(plugin.name), 2u) << line;
    EXPECT_EQ(line.find("dspm", 2 + names), 2 + names + 2) << line;
    EXPECT_EQ(line.substr(2 + names + 2 + 4 + 2), plugin.sentence) << line;
  }
  EXPECT_EQ(found, plugins.size());
}

TEST(Catalogue, DescribesParametersInColumnsAsWideAsTheirContents) {
  std::istringstream lines(describe_plugins("camera:perspective"));
  std::string title, headings;
  std::getline(lines, title), std::getline(lines, headings);
  EXPECT_EQ(title, "camera:perspective (dspm): a pinhole or a thin lens");
  const std::size_t name = headings.find("name"), meaning = headings.find("meaning");
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    for (const std::size_t column : {name, meaning}) {
      EXPECT_EQ(line.substr(column - 2, 2), "  ") << line;
      EXPECT_NE(line.at(column), ' ') << line;
    }
  EXPECT_GE(count, 5);
}

TEST(Catalogue, DescribesWhatNoPluginReads) {
  EXPECT_NE(describe_plugins("sampler:halton").find("integer  pixelsamples"), std::string::npos);
  EXPECT_NE(describe_plugins("independent").find("pixelsamples   4 "), std::string::npos);
  EXPECT_NE(describe_plugins("Option").find("disablepixeljitter"), std::string::npos);
  EXPECT_NE(describe_plugins("principled").find("index of refraction inside over outside (or \"ior\")"),
            std::string::npos);
}

TEST(Catalogue, SaysWhichKindsHaveThatName) {
  try {
    describe_plugins("light:diffuse");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.what(),
              std::string(
                  "--describe light:diffuse: there is no such plugin; there is material:diffuse, area light:diffuse"));
  }
}

// What dspm reads for all lights and all shapes is listed with what they read themselves.
TEST(Catalogue, DescribesWhatPhotonsAreTold) {
  for (const CatalogueEntry& plugin : all_plugins()) {
    std::string names;
    for (const ParamInfo& info : plugin.params()) names += " " + info.name;
    const bool is_light = plugin.kind == "light" || plugin.kind == "area light";
    EXPECT_EQ(names.ends_with(" photons caustics group"), is_light) << plugin.kind << " " << plugin.name << names;
    EXPECT_EQ(names.ends_with(" caustics shadowcatcher"), plugin.kind == "shape") << plugin.kind << names;
  }
}

}  // namespace
}  // namespace dspm
