// What a run leaves behind: images, contact sheet, video and statistics, and which of them could not be written.
#pragma once

#include <set>

#include "app/frame_intervals.h"
#include "app/output.h"
#include "app/run_report.h"
#include "app/write_faults.h"
#include "world/world.h"

namespace dspm {

class Results {
 public:
  enum class Images { so_far, last };

  /// See Output.
  Results(const Job& job, const World& world, const Options& options, Messages& messages);

  std::size_t bytes_while_writing() const { return output_.bytes_while_writing(); }
  /// The images of an interval's frames, `seconds` after its begin; the last ones go to the video, too.
  void write(const FrameList& interval, const Integrator& integrator, double seconds, Images images);
  /// Writes another file of the run; see WriteFaults.
  void attempt(const std::filesystem::path& file, const WriteFaults::Write& write) { faults_.attempt(file, write); }
  void tell_faults() { faults_.tell(); }
  void tell_missing() const { faults_.tell_end(); }
  bool are_whole() const { return !faults_.any(); }

  void say_end(double seconds) const;
  /// The statistics and the video. Whether all files are written.
  bool finish(const RunReport& report);

 private:
  const Job& job_;
  const World& world_;
  const Options& options_;
  Messages& messages_;
  WriteFaults faults_;
  Output output_;
  std::set<Frame> written_;  // frames that have images, as far as files can be written
};

}  // namespace dspm
