// Files that cannot be written during a render. A render is worth more than a file, so it goes on: a fault is reported
// once, every later write tries again, and the end reports what is missing.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "dspm/session/messages.h"

namespace dspm {

class WriteFaults {
 public:
  using Write = std::function<void()>;
  enum class Failed { dropped, kept };
  explicit WriteFaults(Messages& messages) : messages_(messages) {}

  /// Calls `write`, which writes this file and perhaps others that belong to it. Catches WriteError and a lack of
  /// memory. Returns whether it went well; if not, Failed::kept keeps `write` for retry(), as nothing else will write
  /// this file.
  bool attempt(const std::filesystem::path& file, const Write& write, Failed failed = Failed::dropped);
  /// Tries the kept writes again.
  void retry();

  /// Returns whether the last attempt failed for any file.
  bool any() const { return !failed_.empty(); }
  /// Reports new causes, or that all is well again. Call it after writing, in a render that goes on.
  void report();
  /// Reports which files are missing, and why. Call it at the end.
  void report_missing() const;

 private:
  struct Failure {
    std::string cause;
    Write again;  // may be empty
  };
  /// The files that failed for each cause.
  std::map<std::string, std::string> by_cause() const;

  Messages& messages_;
  std::map<std::filesystem::path, Failure> failed_;  // in their last attempt
  std::set<std::string> told_;                       // causes
  bool was_whole_ = true;                            // when last reported
};

}  // namespace dspm
