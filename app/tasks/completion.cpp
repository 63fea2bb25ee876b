#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "dspm/app/options/option_facts.h"
#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/app/tasks/templates.h"

namespace dspm {
namespace {

bool takes_value(const OptionFacts& option) { return !option.value.empty() && !option.has_optional_value(); }

/// Returns the text in single quotes, for bash and zsh.
std::string quoted(const std::string& text) {
  std::string all;
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + all + "'";
}

/// Returns what bash does for a value: nothing for values that only the user knows.
std::string bash_action(const OptionFacts& option) {
  if (!option.choices.empty())
    return fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$current\"))", fmt::join(option.choices, " "));
  if (option.value.starts_with("FILE")) return "compopt -o default";
  if (option.value == "DIR") return "compopt -o dirnames";
  return "";
}

std::string for_bash() {
  std::map<std::string, std::string> names_by_action;
  std::string all;
  for (const OptionFacts& option : all_options()) {
    if (!option.is_option()) continue;
    all += fmt::format("{} ", fmt::join(option.names, " "));
    std::string& names = names_by_action[bash_action(option)];
    if (takes_value(option)) names += fmt::format("{}{}", names.empty() ? "" : "|", fmt::join(option.names, "|"));
  }
  std::string cases;
  for (const auto& [action, names] : names_by_action)
    if (!names.empty())
      cases += fmt::format("    {})\n      {}{}return ;;\n", names, action, action.empty() ? "" : "\n      ");
  all.pop_back();
  return fmt::format(R"(# bash: completes the options of dspm. Made by dspm --completion bash.
_dspm() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} option=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  # --outfile=a.exr is three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $option == = ]]; then
    option=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  case $option in
{}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W '{}' -- "$current"))
  else
    compopt -o default
  fi
}}
complete -F _dspm dspm
)",
                     cases, all);
}

/// Returns ":FILE:_files" and the like; an optional value has two colons.
std::string zsh_values(const OptionFacts& option) {
  if (option.value.empty()) return "";
  if (option.value == " [oidn]") return "::denoiser:(oidn)";
  if (option.has_optional_value()) return "::value:_files";
  std::string all;
  std::istringstream words(option.value);
  for (std::string word; words >> word;) {
    const std::string action = !option.choices.empty()    ? fmt::format("({})", fmt::join(option.choices, " "))
                               : word.starts_with("FILE") ? "_files"
                               : word == "DIR"            ? "_files -/"
                                                          : " ";
    all += fmt::format(":{}:{}", escaped(word, ":"), action);
  }
  return all;
}

std::string for_zsh() {
  std::string lines;
  for (const OptionFacts& option : all_options()) {
    if (!option.is_option()) continue;
    const std::string sentence = fmt::format("[{}]", escaped(option.sentence, "[]\\")), values = zsh_values(option);
    const std::string others = fmt::format("({})", fmt::join(option.names, " "));
    for (const std::string& name : option.names) {
      // After a long name, the value may follow "="; an optional one must.
      const char* const joint = !name.starts_with("--") || values.empty() ? ""
                                : option.has_optional_value()             ? "=-"
                                                                          : "=";
      lines += fmt::format("  {} \\\n", quoted((option.repeats ? "*" : others) + name + joint + sentence + values));
    }
  }
  return fmt::format(
      "#compdef dspm\n# zsh: completes the options of dspm. Made by dspm --completion zsh.\n"
      "_arguments -S \\\n{}  '*:scene:_files'\n",
      lines);
}

std::string for_fish() {
  std::string lines;
  for (const OptionFacts& option : all_options()) {
    if (!option.is_option()) continue;
    std::string line = "complete -c dspm";
    for (const std::string& name : option.names)
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.choices.empty())
      line += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
    else if (option.value.starts_with("FILE"))
      line += " -r -F";
    else if (option.value == "DIR")
      line += " -x -a '(__fish_complete_directories)'";
    else if (takes_value(option))
      line += " -x";
    lines += fmt::format("{} -d '{}'\n", line, escaped(option.sentence, "\\'"));
  }
  return "# fish: completes the options of dspm. Made by dspm --completion fish.\n" + lines;
}

}  // namespace

std::vector<std::string> completing_shells() { return {"bash", "zsh", "fish"}; }

std::string completion_for(const std::string& shell) {
  return shell == "bash" ? for_bash() : shell == "zsh" ? for_zsh() : for_fish();
}

}  // namespace dspm
