#include "dspm/output/write_faults.h"

#include <fmt/format.h>

#include <exception>
#include <utility>
#include <vector>

#include "dspm/base/system/atomic_file.h"
#include "dspm/session/out_of_memory.h"

namespace dspm {
namespace {

/// Returns "a.exr", "a.exr and b.exr", "a.exr to z.exr (26 files)" and the like.
std::string in_words(const std::vector<std::string>& files) {
  if (files.size() == 1) return files.front();
  if (files.size() == 2) return files.front() + " and " + files.back();
  return fmt::format("{} to {} ({} files)", files.front(), files.back(), files.size());
}

}  // namespace

bool WriteFaults::attempt(const std::filesystem::path& file, const Write& write, Failed failed) {
  std::string cause;
  try {
    write();
    failed_.erase(file);
    return true;
  } catch (const WriteError& error) {
    cause = error.cause();
  } catch (const std::exception& error) {
    if (!is_out_of_memory(error)) throw;
    cause = "there is not enough memory for it";
  }
  failed_[file] = {cause, failed == Failed::kept ? write : Write()};
  return false;
}

void WriteFaults::retry() {
  const std::map<std::filesystem::path, Failure> failed = failed_;
  for (const auto& [file, failure] : failed)
    if (failure.again) attempt(file, failure.again, Failed::kept);
}

std::map<std::string, std::string> WriteFaults::by_cause() const {
  std::map<std::string, std::vector<std::string>> files;
  for (const auto& [file, failure] : failed_) files[failure.cause].push_back(file.string());
  std::map<std::string, std::string> words;
  for (const auto& [cause, of_cause] : files) words[cause] = in_words(of_cause);
  return words;
}

void WriteFaults::report() {
  for (const auto& [cause, files] : by_cause())
    if (told_.insert(cause).second)
      messages_.warn(fmt::format("cannot write {}: {}", files, cause),
                     "the render goes on, and every later write tries again");
  if (!any() && !std::exchange(was_whole_, true)) messages_.say("the files that could not be written are written now");
  was_whole_ = !any();
}

void WriteFaults::report_missing() const {
  for (const auto& [cause, files] : by_cause()) messages_.fail(fmt::format("cannot write {}: {}", files, cause));
}

}  // namespace dspm
