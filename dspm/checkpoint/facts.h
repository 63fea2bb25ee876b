// What a render depends on: a checkpoint keeps it, so that a render is never continued with another scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/system/state_stream.h"
#include "dspm/world/job.h"

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

/// To be called after the world is made, as the files read for it are included. Settings that change no pixel are not
/// (names of images, iterations to go, threads, the accelerator), nor is the memory bound, which only changes rounding,
/// nor which frames are rendered. `part`: of the file's frames; more may have been added.
std::vector<Fact> facts_of(const Job& job, const FramesPart& part);
/// Those of the scene itself: its description and the files that were read.
std::vector<Fact> facts_of_scene(const Job& job, const FramesPart& part);
/// A digest of all of them, and of the version of dspm: two machines that have the same render the same.
std::string digest_of(const Job& job);
/// All frames of the file.
FramesPart all_frames(const Job& job);

/// Whose facts `then` are, and the hint to each error.
struct Since {
  const char* what = "the checkpoint";
  const char* way_out = "a checkpoint continues only the same scene; to start over, use another checkpoint";
};
/// A fact that has changed, or is in one of the lists only: the other pointer is null then.
struct Difference {
  const Fact *then, *now;

  /// "material "legs" has changed since the checkpoint"
  std::string in_words(const Since& since = {}) const;
  SourceLocation where() const { return now != nullptr ? now->where : SourceLocation(); }
};
/// In the order of `now`, but for what may be new, then those only in `then`.
std::vector<Difference> differences(const std::vector<Fact>& then, const std::vector<Fact>& now);
/// An error for each.
void compare(const std::vector<Fact>& then, const std::vector<Fact>& now, Diagnostics& diagnostics,
             const Since& since = {});

void persist(std::vector<Fact>& facts, StateStream& state);

}  // namespace dspm
