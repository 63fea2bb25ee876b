#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "dspm/app/tasks/tasks.h"
#include "dspm/app/tasks/templates.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/file_access.h"
#include "dspm/base/system/version.h"
#include "dspm/session/job/integrator_choice.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

/// The scene's lines for a kind: the usual one, and the one with the new plugin.
struct SceneLine {
  const char *kind, *usual, *own;
};
constexpr SceneLine kSceneLines[] = {
    {"integrator", "Integrator \"dsppm\" \"string direct\" \"sampled\" \"integer iterations\" 16",
     "Integrator \"@name@\""},
    {"accelerator", "", "Accelerator \"@name@\""},
    {"camera", "Camera \"perspective\" \"float fov\" 40", "Camera \"@name@\" \"float fov\" 100"},
    {"light", "LightSource \"point\" \"point3 from\" [2 4 -3] \"rgb I\" [60 58 54]",
     "AttributeBegin Translate 2 4 -3 LightSource \"@name@\" \"rgb I\" [60 58 54] AttributeEnd"},
    {"area light", "", "AreaLightSource \"@name@\" \"rgb L\" [6 5 4]"},
    {"filter", "", "PixelFilter \"@name@\" \"float radius\" 1.5"},
    {"texture", "", "Texture \"pattern\" \"spectrum\" \"@name@\" \"rgb light\" [.8 .75 .6] \"rgb dark\" [.15 .2 .35]"},
    {"medium", "",
     "MakeNamedMedium \"air\" \"string type\" \"@name@\"\nAttributeBegin MediumInterface \"air\" \"\" Material "
     "\"interface\" Translate 0 1 2 Shape \"sphere\" \"float radius\" 1.5 AttributeEnd"},
    {"material", "Material \"diffuse\" \"rgb reflectance\" [.7 .6 .5]",
     "Material \"@name@\" \"rgb reflectance\" [.7 .6 .5]"},
    {"shape", "Shape \"disk\" \"float radius\" 1.5", "Shape \"@name@\" \"float width\" 3 \"float height\" 2"},
};

using Words = TemplateWords;

Words words_of(std::string_view kind, const std::string& name) {
  Words words;
  for (const SceneLine& line : kSceneLines)
    words[line.kind] = filled(line.kind == kind ? line.own : line.usual, {{"name", name}});
  for (auto& [word, value] : words)
    if (!value.empty()) value.pop_back();  // the end of the line
  if (kind == "texture") words["material"] = "Material \"diffuse\" \"texture reflectance\" \"pattern\"";
  if (kind == "medium") words["integrator"] = "Integrator \"path\" \"integer iterations\" 64";
  words["name"] = name, words["kind"] = kind, words["version"] = kVersion.substr(0, kVersion.rfind('.'));
  return words;
}

/// Returns the name of a kind as one word, for the command line and the names of templates.
std::string word_of(std::string kind) {
  std::replace(kind.begin(), kind.end(), ' ', '-');
  return kind;
}

/// Returns the kind as the tables of plugins name it.
std::string kind_of(const std::string& word) {
  std::vector<std::string> words;
  for (const SceneLine& line : kSceneLines) {
    words.push_back(word_of(line.kind));
    if (word_of(word) == words.back()) return line.kind;
  }
  throw UsageError(
      fmt::format("--new-plugin {}: there is no such kind; choose one of: {}", word, fmt::join(words, ", ")));
}

void check(const std::string& kind, const std::string& name, const fs::path& folder) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits) || name[0] < 'a' || name == "test")
    throw UsageError(fmt::format(
        "--new-plugin {} {}: a name is made of a-z, 0-9 and _, begins with a letter, and is not \"test\"", kind, name));
  if (kind == "integrator" && !stand_in_for(name).empty())
    throw UsageError(fmt::format("--new-plugin: in pbrt scenes the integrator \"{}\" means \"{}\"; choose another name",
                                 name, stand_in_for(name)));
  if (is_plugin(kind, name)) throw UsageError(fmt::format("--new-plugin: {} \"{}\" exists already", kind, name));
  std::error_code ignored;
  if (fs::exists(folder, ignored) && (!fs::is_directory(folder, ignored) || !fs::is_empty(folder, ignored)))
    throw UsageError(fmt::format("--new-plugin: {} exists already, and is not an empty folder", folder.string()));
}

/// Returns the option by which CMake finds the package of this very program; empty if CMake looks there anyway.
std::string package_place(const fs::path& program) {
  const fs::path folder = program.parent_path(), prefix = folder.parent_path();
  if (folder.filename() != "bin" || prefix == "/usr" || prefix == "/usr/local") return {};
  return " -DCMAKE_PREFIX_PATH=" + shell_word(prefix.string());
}

/// Returns the commands that build, test and try it.
std::string commands(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  return fmt::format(
      "cd {}\ncmake -B build{} && cmake --build build && ctest --test-dir build\n"
      "{} --plugin build/lib{}.so {}.dsc --png\n",
      shell_word(folder.string()), package_place(program), shell_word(program.string()), name, name);
}

}  // namespace

std::string new_plugin(const std::string& kind, const std::string& name, const fs::path& folder) {
  expect_allowed(folder);
  const std::string table_kind = kind_of(kind), file = word_of(table_kind);
  check(table_kind, name, folder);
  fs::create_directories(folder);
  const Words words = words_of(table_kind, name);
  write_file(folder / "CMakeLists.txt", filled(template_text("CMakeLists.txt"), words));
  write_file(folder / (name + ".cpp"), filled(template_text(file + ".cpp"), words));
  write_file(folder / (name + "_test.cpp"), filled(template_text(file + "_test.cpp"), words));
  write_file(folder / (name + ".dsc"), filled(template_text("scene.dsc"), words));
  return commands(folder, name);
}

}  // namespace dspm
