// A checkpoint file: which render it belongs to, and the state of each of its frame intervals. It replaces the previous
// one atomically, and a checksum reveals damage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/checkpoint/facts.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/part.h"

namespace dspm {

/// The progress of an interval.
struct IntervalState {
  Places places;                       // in the file of that time
  int iterations = 0;                  // done; 0: no state
  double seconds = 0;                  // the time that they and making the scene took
  std::uint64_t offset = 0, size = 0;  // of the state in the file
};

/// Throws std::runtime_error, naming the file, if a frame is there twice or too many are together.
void expect_frames(const std::vector<IntervalState>& intervals, const std::string& file);

class CheckpointFile {
 public:
  /// The first bytes of the file; then come its head, the states, and the checksum of both.
  static constexpr std::string_view kMagic = "dspm checkpoint 12\n";

  /// Reads and checks everything but the states. Throws std::runtime_error, naming the file, if it is damaged or not a
  /// checkpoint.
  explicit CheckpointFile(const std::filesystem::path& path);

  /// The render that it belongs to.
  struct Render {
    std::vector<Fact> facts;
    KnownFrames frames;         // those of the file
    std::string sampling = {};  // World::sampling
    Part part = {};
    std::uint64_t memory = 0;                // bound of a part, which cuts it into intervals and batches; 0: none
    std::vector<std::string> machines = {};  // the machines that worked on it
    std::vector<std::string> words = {};     // the command line of a part
  };
  const Render& render() const { return render_; }
  const std::vector<IntervalState>& intervals() const { return intervals_; }
  /// Loads the state into an integrator that was made for that interval.
  void load(std::size_t interval, Integrator& integrator) const;
  /// Adds the state to that of other parts, which the integrator holds.
  void add(std::size_t interval, Integrator& integrator) const;
  const std::filesystem::path& path() const { return path_; }

  /// Returns whether `path` names this very file now.
  bool is_at(const std::filesystem::path& path) const;

  /// An interval's state to save.
  struct NewState {
    std::size_t interval;
    Integrator& integrator;
  };
  /// Writes `path` anew, with the state of one interval or of none. The other states come from `before`, where
  /// `intervals` say; it may be null or the file that is replaced. Throws WriteError; the old file then stays.
  static std::unique_ptr<const CheckpointFile> write(const std::filesystem::path& path, const Render& render,
                                                     std::vector<IntervalState> intervals, const NewState* state,
                                                     const CheckpointFile* before);

 private:
  CheckpointFile() = default;
  class SavingStream;
  void open(const std::filesystem::path& path);
  template <class Stream>
  void load_by(std::size_t interval, Integrator& integrator) const;
  /// Returns false if the state could not be read.
  bool copy(const IntervalState& state, SavingStream& to) const;

  std::filesystem::path path_;
  std::uint64_t device_ = 0, inode_ = 0;
  mutable std::ifstream file_;  // stays readable when another file takes its name
  Render render_;
  std::vector<IntervalState> intervals_;
};

}  // namespace dspm
