// Options that belong together. Each group has a file of this room; options.cpp lists them.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "dspm/app/options/options.h"

namespace dspm {

struct OptionGroup {
  void (*add)(CLI::App&, Options&);
  /// Throws UsageError if the options do not fit one another. May be null.
  void (*check)(const Options&);
};

extern const OptionGroup scene_options, task_options, work_options, file_options, looking_options, part_options;

/// Rejects "", which would otherwise count as an option that is not given.
inline const CLI::Validator kNamesAFile(
    [](const std::string& name) { return name.empty() ? "a file's name is missing" : ""; }, "");

/// Accepts these values only, and names them to facts_of().
inline CLI::Validator one_of(const std::vector<std::string>& choices) {
  return CLI::IsMember(choices).description("").name(fmt::format("{}", fmt::join(choices, "|")));
}

using ReadText = std::function<void(const std::string&)>;

inline void add_text(CLI::App& app, const char* names, const char* value, const char* sentence, const ReadText& read) {
  app.add_option_function<std::string>(names, read, sentence)->type_name(value);
}

inline void add_file(CLI::App& app, const char* names, std::string& file, const char* sentence) {
  app.add_option(names, file, sentence)->check(kNamesAFile)->type_name("FILE");
}

inline constexpr int kMaxCount = 1'000'000'000;

template <class Count>
void add_count(CLI::App& app, const char* names, Count& count, int lowest, int highest, const char* sentence) {
  app.add_option(names, count, sentence)->check(CLI::Range(lowest, highest).description(""))->type_name("N");
}

}  // namespace dspm
