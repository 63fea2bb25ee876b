// What dspm says to the user, all on stderr: standard output is for data.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>

#include "app/standard_streams.h"
#include "core/errors.h"

namespace dspm {

class Messages {
 public:
  explicit Messages(bool quiet) : quiet_(quiet) {}

  /// Warnings and, unless quiet, notes; each once. Errors are left to throw_if_errors.
  void show(const Diagnostics& diagnostics);
  /// A warning of no place in a scene.
  void warn(std::string message, std::string hint = {});

  template <class... Values>
  void say(fmt::format_string<Values...> format, Values&&... values) const {
    if (!quiet_) print_message(fmt::format("dspm: {}\n", fmt::format(format, std::forward<Values>(values)...)));
  }

 private:
  bool quiet_;
  std::set<std::string> shown_;
};

}  // namespace dspm
