#include "dspm/session/load_modules.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "dspm/base/system/file_access.h"
#include "dspm/session/modules/load.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPathVariable = "DSPM_PLUGIN_PATH";

std::vector<fs::path> folders() {
  std::vector<fs::path> found;
  const char* const variable = std::getenv(kPathVariable);
  std::string_view rest = variable != nullptr ? variable : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) found.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return found;
}

std::set<fs::path> libraries_in(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".so") files.insert(entry.path());
  if (error) throw UsageError(fmt::format("{}: {}: {}", kPathVariable, folder.string(), error.message()));
  return files;
}

fs::path find(const ModuleUse& use, const SceneDescription& description) {
  std::vector<fs::path> places = {fs::path(use.where.file->name).parent_path(), description.main_directory()};
  const std::vector<fs::path> others = folders();
  places.insert(places.end(), others.begin(), others.end());
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::exists(place / use.file, ignored)) return place / use.file;
  return {};
}

}  // namespace

void load_modules(const std::vector<std::string>& files) {
  if (files_are_confined() && !files.empty())
    throw UsageError(fmt::format("--plugin {}: --sandbox loads no plugins; leave out one of the two", files[0]));
  if (files_are_confined() && !folders().empty())
    throw UsageError(
        fmt::format("--sandbox loads no plugins, but {0} is set; run it as: env -u {0} dspm ...", kPathVariable));
  try {
    for (const fs::path& folder : folders())
      for (const fs::path& file : libraries_in(folder)) load_module(file);
    for (const std::string& file : files) load_module(file);
  } catch (const ModuleError& error) {
    throw UsageError(error.what());
  }
}

void load_modules(const SceneDescription& description, Diagnostics& diagnostics) {
  for (const ModuleUse& use : description.modules) {
    if (files_are_confined()) {
      diagnostics.error(use.where, "--sandbox loads no plugins", "leave it out if you trust whoever wrote this scene");
      continue;
    }
    const fs::path file = find(use, description);
    if (file.empty()) {
      diagnostics.error(
          use.where, fmt::format("there is no module \"{}\"", use.file),
          fmt::format("it is looked for next to this file, next to the main file and in {}", kPathVariable));
      continue;
    }
    try {
      load_module(file);
    } catch (const ModuleError& error) {
      diagnostics.error(use.where, error.what());
    }
  }
}

}  // namespace dspm
