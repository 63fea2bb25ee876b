#include "dspm/app/farm.h"

#include <fmt/format.h>

#include <filesystem>

#include "dspm/app/templates.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::string in_shell(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(shell_word(word));
  return fmt::format("{}", fmt::join(quoted, " "));
}

/// Within a template literal of JavaScript.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '`' || c == '$') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

std::vector<std::string> farms() { return {"slurm", "openjd", "flamenco"}; }

std::string farm_job(const Options& options) {
  const std::string name = fs::path(options.scenes.front()).stem().string();
  TemplateWords words = {{"dspm", shell_word(fs::read_symlink("/proc/self/exe").string())},
                         {"directory", shell_word(fs::current_path().string())},
                         {"folder", shell_word(name + ".parts")},
                         {"render", in_shell(options.words_of_render)},
                         {"images", in_shell(options.words_of_images)}};
  if (options.farm == "flamenco")
    for (auto& [word, value] : words) value = escaped(value);
  words["name"] = words["scene"] = name;
  words["parts"] = std::to_string(options.farm_parts.value_or(8));
  return filled(template_text("farm." + options.farm), words);
}

}  // namespace dspm
