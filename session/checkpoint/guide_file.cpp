#include "dspm/session/checkpoint/guide_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/read_file.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/session/checkpoint/facts.h"

namespace dspm {
namespace {

// The file holds kGuideMagic, a digest of the rest, the scene's facts, and what was learned.
constexpr std::string_view kGuideMagic = "dspm guide 4\n";
constexpr const char* kSameScene =
    "a guide suits only the scene that it was learned for; without --guide, dspm learns anew";

void persist(std::vector<Fact>& facts, FileSample& learned, StateStream& state) {
  dspm::persist(facts, state);
  learned.persist(state);
}

std::string digest_in_bytes(std::string_view bytes) {
  SavedState saved;
  std::uint64_t number = digest(bytes);
  saved.value(number);
  return saved.all;
}

/// Returns the bytes without the magic and the digest.
std::string_view content_of(std::string_view bytes) {
  if (!bytes.starts_with(kGuideMagic)) throw std::runtime_error("it is not a guide of this version of dspm");
  bytes.remove_prefix(kGuideMagic.size());
  const std::size_t size = std::min(sizeof(std::uint64_t), bytes.size());
  const std::string_view content = bytes.substr(size);
  if (bytes.substr(0, size) != digest_in_bytes(content)) throw std::runtime_error("it is damaged");
  return content;
}

}  // namespace

void save_guide(const std::filesystem::path& path, const Job& job) {
  if (!job.settings.file->has_learned())
    throw UsageError(fmt::format("--save-guide {}: integrator \"{}\" learns nothing here about where photons start",
                                 path.string(), job.integrator));
  std::vector<Fact> facts = facts_of_scene(job, job.description->frames.base());
  SavedState content;
  persist(facts, *job.settings.file, content);
  write_file(path, std::string(kGuideMagic) + digest_in_bytes(content.all) + content.all);
}

void load_guide(const std::filesystem::path& path, const Job& job) {
  std::vector<Fact> then;
  try {
    const std::string bytes = read_other_bytes(path);
    LoadedState state(content_of(bytes));
    persist(then, *job.settings.file, state);
    if (!state.all_read()) throw std::runtime_error("it is damaged");
    job.settings.file->take_as_given(digest(bytes));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("guide {}: {}", path.string(), error.what()));
  }
  Diagnostics diagnostics;
  compare(then, facts_of_scene(job, job.description->frames.base()), diagnostics, {"the guide", kSameScene});
  diagnostics.throw_if_errors();
}

void expect_guide_is_used(const std::filesystem::path& path, const Job& job) {
  if (!job.settings.file->is_used())
    throw UsageError(
        fmt::format("--guide {}: integrator \"{}\" starts no photons by a guide here", path.string(), job.integrator));
}

}  // namespace dspm
