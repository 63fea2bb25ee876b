// Messages of a session to its user: on stderr, unless print() is overridden.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "dspm/base/params/errors.h"

namespace dspm {

class Messages {
 public:
  /// Shows only warnings if `quiet`.
  explicit Messages(bool quiet) : quiet_(quiet) {}
  virtual ~Messages() = default;

  /// Shows warnings and, unless quiet, notes; each once. Errors are left to throw_if_errors.
  void show(const Diagnostics& diagnostics);
  /// Shows a warning without a place in a scene.
  void warn(std::string message, std::string hint = {});

  template <class... Values>
  void say(fmt::format_string<Values...> format, Values&&... values) const {
    if (!quiet_) print(fmt::format("dspm: {}\n", fmt::format(format, std::forward<Values>(values)...)));
  }

  /// Shows an error, even if quiet.
  void fail(const std::string& message) const { print(fmt::format("dspm: {}\n", message)); }

 protected:
  /// Prints whole lines.
  virtual void print(std::string_view text) const;

 private:
  bool quiet_;
  std::set<std::string> shown_;
};

}  // namespace dspm
