// Progress of the evaluation, on stderr: standard output is for results.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace dspm {

/// A line with the time since the program's start.
void say_line(const std::string& line);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_line(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace dspm
