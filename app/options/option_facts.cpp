#include "dspm/app/options/option_facts.h"

#include <algorithm>
#include <sstream>

namespace dspm {
namespace {

bool is_flag(const CLI::Option& option) { return option.get_expected_max() == 0; }

/// Returns the names of the only values, as one_of() has written them.
std::vector<std::string> choices_of(CLI::Option& option) {
  std::vector<std::string> choices;
  try {
    std::istringstream names(option.get_validator(0)->get_name());
    for (std::string name; std::getline(names, name, '|');) choices.push_back(name);
  } catch (const CLI::OptionNotFound&) {  // there is no validator
  }
  return choices;
}

OptionFacts facts_of(const CLI::App& app, const CLI::Option& option) {
  OptionFacts facts;
  for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
  facts.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  facts.value = option.get_type_name();
  facts.sentence = option.get_description();
  if (facts.names.empty())
    facts.names.push_back(option.get_name(true));
  else
    facts.choices = choices_of(*const_cast<CLI::App&>(app).get_option(facts.names.front()));
  return facts;
}

}  // namespace

std::vector<OptionFacts> facts_of(const CLI::App& app) {
  std::vector<OptionFacts> all;
  for (const CLI::Option* option : app.get_options()) all.push_back(facts_of(app, *option));
  return all;
}

std::string help_of(const CLI::App& app) {
  std::string help = app.help();
  for (const CLI::Option* option : app.get_options()) {
    if (!is_flag(*option) || option->get_type_name().empty()) continue;
    const std::string name = "--" + option->get_lnames().front(), value = option->get_type_name();
    const std::size_t begin = help.find(name + "{");
    std::size_t end = help.find('}', begin) + 1;
    if (help.compare(end, value.size() + 1, " " + value) == 0) end += value.size() + 1;
    const std::size_t length = help.find_first_not_of(' ', end) - begin;
    std::string shown = name + value;
    shown.resize(std::max(length, shown.size() + 1), ' ');  // so that columns stay in line
    help.replace(begin, length, shown);
  }
  return help;
}

}  // namespace dspm
