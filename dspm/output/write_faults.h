// Files that cannot be written while a render goes on. A render is worth more than a file, so it does not end for that:
// what is wrong is said once, every later write tries anew, and the end knows what is missing.
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

  /// Calls `write`, which writes this file and perhaps others that belong to it. A WriteError and a lack of memory end
  /// here. Whether it went well; if not, `write` is kept for retry() where nobody else will write this file.
  bool attempt(const std::filesystem::path& file, const Write& write, Failed failed = Failed::dropped);
  /// What is kept, once more.
  void retry();

  /// There is a file whose last attempt failed.
  bool any() const { return !failed_.empty(); }
  /// After writing, in a render that goes on: causes that are new, and that all is well again.
  void tell();
  /// In the end: which files are missing, and why.
  void tell_end() const;

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
  bool was_whole_ = true;                            // when last told
};

}  // namespace dspm
