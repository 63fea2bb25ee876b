// A checkpoint as a file: of which render it is, and the state of each of its frame intervals. It replaces the one
// before in one step, and a checksum tells of damage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/checkpoint/facts.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/frame_intervals.h"

namespace dspm {

/// Where an interval stands.
struct IntervalState {
  FrameList frames;
  int iterations = 0;                  // done; 0: there is no state
  double seconds = 0;                  // that they took
  std::uint64_t offset = 0, size = 0;  // of the state in the file
};

class CheckpointFile {
 public:
  /// What such a file begins with; then its head, the states, and the checksum of both.
  static constexpr std::string_view kMagic = "dspm checkpoint 2\n";

  /// Reads and checks everything but the states. Throws std::runtime_error, naming the file, where it is damaged or
  /// none.
  explicit CheckpointFile(const std::filesystem::path& path);

  const std::vector<Fact>& facts() const { return facts_; }
  const std::vector<IntervalState>& intervals() const { return intervals_; }
  /// Into an integrator that was made for that interval.
  void load(std::size_t interval, Integrator& integrator) const;

  /// Whether it is this file that has the name now.
  bool is_at(const std::filesystem::path& path) const;

  /// An interval's state that is to be saved.
  struct NewState {
    std::size_t interval;
    Integrator& integrator;
  };
  /// Writes `path` anew, with the state of one interval or of none; those of the others come from `before`, which may be
  /// null or the file that is replaced. Throws WriteError; the file is then as before.
  static std::unique_ptr<const CheckpointFile> write(const std::filesystem::path& path, const std::vector<Fact>& facts,
                                                     std::vector<IntervalState> intervals, const NewState* state,
                                                     const CheckpointFile* before);

 private:
  CheckpointFile() = default;
  class SavingStream;
  void open(const std::filesystem::path& path);
  /// Whether it could be read.
  bool copy(std::size_t interval, SavingStream& to) const;

  std::filesystem::path path_;
  std::uint64_t device_ = 0, inode_ = 0;
  mutable std::ifstream file_;  // stays readable when another one takes its name
  std::vector<Fact> facts_;
  std::vector<IntervalState> intervals_;
};

/// Bytes of its state; nothing where there are no checkpoints of it.
std::optional<std::uint64_t> state_bytes(Integrator& integrator);

}  // namespace dspm
