// What --help knows of each option, for whoever else shows it: the manual page, and shells that complete command lines.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace dspm {

struct OptionFacts {
  std::vector<std::string> names;  // "-o", "--outfile"; of the files that need no option, one without a dash
  std::string value;               // "FILE", "KIND NAME DIR"; of an option that may do without, "[=FILE]" or " [PORT]"
  std::vector<std::string> choices;  // all that the value may be; empty: what fits
  std::string sentence;
  bool repeats = false;  // each time counts, not just the last

  bool is_option() const { return names.front().starts_with('-'); }
  bool has_optional_value() const { return value.find('[') < 2; }
};

/// Returns them in the order of --help.
std::vector<OptionFacts> facts_of(const CLI::App& app);

/// Returns the text of --help, in which flags show the values that they may have: CLI11 shows their defaults.
std::string help_of(const CLI::App& app);

}  // namespace dspm
