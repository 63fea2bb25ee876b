// The facts that a render depends on. A checkpoint keeps them, so that a render is never continued with another scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/system/state_stream.h"
#include "dspm/session/job/job.h"

namespace dspm {

/// Something that the images depend on; `text` is its value or a digest of it.
struct Fact {
  enum class Scope : std::uint8_t {
    all,          // frames
    variation,    // those that choose a variation of the name `of`
    combination,  // those of the product's variation `of`
    file,         // those whose other facts name it
  };

  std::string name, text;
  bool is_digest = false;
  Scope scope = Scope::all;
  std::string of = {};
  SourceLocation where = {};  // in the scene; not kept in checkpoints
  bool may_be_new = false;    // it matters to no frame of the part; not kept either
};

/// Returns the facts of a job. Call it after the world is made, as the files read for it are included. Settings that
/// change no pixel are not included (names of images, iterations to go, threads, the accelerator), nor is the memory
/// bound, which only changes rounding, nor which frames are rendered. `part` is that of the file's frames; more may
/// have been added.
std::vector<Fact> facts_of(const Job& job, const FramesPart& part);
/// Returns the facts of the scene itself: its description and the files that were read.
std::vector<Fact> facts_of_scene(const Job& job, const FramesPart& part);
/// Returns a digest of all facts, and of the version of dspm: two machines with the same digest render the same.
std::string digest_of(const Job& job);
FramesPart all_frames(const Job& job);

/// The words for what an earlier list of facts belongs to, and the hint for each error.
struct Since {
  const char* what = "the checkpoint";
  const char* way_out = "a checkpoint continues only the same scene; to start over, use another checkpoint";
};
/// A fact that has changed, or is in only one of the lists; the other pointer is then null.
struct Difference {
  const Fact *then, *now;

  /// Returns "material "legs" has changed since the checkpoint" and the like.
  std::string in_words(const Since& since = {}) const;
  SourceLocation where() const { return now != nullptr ? now->where : SourceLocation(); }
};
/// Returns the differences in the order of `now`, except for what may be new; then those that are only in `then`.
std::vector<Difference> differences(const std::vector<Fact>& then, const std::vector<Fact>& now);
/// Reports an error for each difference.
void compare(const std::vector<Fact>& then, const std::vector<Fact>& now, Diagnostics& diagnostics,
             const Since& since = {});

void persist(std::vector<Fact>& facts, StateStream& state);

}  // namespace dspm
