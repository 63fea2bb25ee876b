// Shells that complete dspm's options, and the manual page: they name what --help names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "dspm/app/options/option_facts.h"
#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/find_program.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

using Words = std::set<std::string>;

/// Returns all that the command says.
std::string output_of(const TemporaryDirectory& directory, const std::string& command) {
  const int code = shell(directory, command);
  const std::string text = contents(directory / "out.txt") + contents(directory / "err.txt");
  return code == 0 ? text : "failed: " + text;
}

Words words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

Words names_beginning_with(const std::string& begin) {
  Words names;
  for (const OptionFacts& option : all_options())
    for (const std::string& name : option.names)
      if (name.starts_with(begin)) names.insert(name);
  return names;
}

/// What bash offers for the last of the words that it has made of a command line.
Words offered(const std::string& words) {
  const TemporaryDirectory directory;
  put_file(directory / "dspm", completion_for("bash"));
  put_file(directory / "ask",
           "compopt() { echo \"[$2]\"; }\n. \"$(dirname \"$0\")/dspm\"\nCOMP_WORDS=(dspm " + words +
               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_dspm\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
  return words_of(output_of(directory, "bash ./ask"));
}

TEST(Completion, OfBashOffersNames) {
  EXPECT_EQ(offered("--se"), names_beginning_with("--se"));
  EXPECT_EQ(offered("a.dsc --png -"), names_beginning_with("-"));
  EXPECT_EQ(offered("a.dsc"), Words{"[default]"});
}

TEST(Completion, OfBashOffersValues) {
  EXPECT_EQ(offered("--studio ''"), (Words{"auto", "on", "off"}));
  EXPECT_EQ(offered("--studio = o"), (Words{"on", "off"}));
  EXPECT_EQ(offered("--studio ="), (Words{"auto", "on", "off"}));
  EXPECT_EQ(offered("--completion ''"), (Words{"bash", "zsh", "fish"}));
  EXPECT_EQ(offered("-o x"), Words{"[default]"});
  EXPECT_EQ(offered("--sandbox ''"), Words{"[dirnames]"});
  EXPECT_EQ(offered("--seed ''"), Words{}) << "a number that only the user knows";
}

TEST(Completion, IsAScriptOfItsShell) {
  for (const std::string& name : completing_shells()) {
    if (find_program(name).empty()) continue;
    const TemporaryDirectory directory;
    put_file(directory / "script", completion_for(name));
    EXPECT_EQ(output_of(directory, name + " -n script"), "") << name;
  }
}

TEST(Completion, KnowsAllOptions) {
  EXPECT_GT(all_options().size(), 70u);
  const std::string zsh = completion_for("zsh"), fish = completion_for("fish"), man = manual_page();
  for (const OptionFacts& option : all_options()) {
    if (!option.names.front().starts_with("-")) continue;
    for (const std::string& name : option.names) {
      EXPECT_NE(zsh.find(name), zsh.npos) << name;
      EXPECT_TRUE(std::regex_search(
          fish, std::regex(name.starts_with("--") ? " -l " + name.substr(2) + " " : " -s " + name.substr(1) + " ")))
          << name;
      const std::string typed = std::regex_replace(name, std::regex("-"), "\\-");
      EXPECT_NE(man.find("\\fB" + typed + "\\fR"), man.npos) << typed;
    }
  }
  EXPECT_NE(zsh.find("'(--studio)--studio=["), zsh.npos);
  EXPECT_NE(zsh.find(":KIND:(auto on off)'"), zsh.npos);
  EXPECT_NE(zsh.find("'*--plugin=["), zsh.npos);
  EXPECT_NE(fish.find(" -l studio -x -a 'auto on off' -d "), fish.npos);
}

// A line that begins with a dot is a request; those that are used are man(7)'s.
TEST(ManualPage, HasNoStrayRequests) {
  const Words known = {".TH", ".SH", ".B", ".I", ".RI", ".TP", ".PP"};
  std::istringstream lines(manual_page());
  for (std::string line; std::getline(lines, line);) {
    EXPECT_FALSE(line.starts_with("'")) << line;
    if (!line.starts_with(".")) continue;
    EXPECT_TRUE(known.contains(line.substr(0, line.find(' ')))) << line;
  }
}

}  // namespace
}  // namespace dspm::test
