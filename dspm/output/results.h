// What a run leaves behind: images, contact sheet, video and statistics, and which of them could not be written.
#pragma once

#include <set>

#include "dspm/math/frames.h"
#include "dspm/output/output.h"
#include "dspm/output/run_report.h"
#include "dspm/output/write_faults.h"
#include "dspm/session/observer.h"
#include "dspm/world/world.h"

namespace dspm {

class Results {
 public:
  using Images = SessionObserver::Images;

  /// See Output. `keep_failed`: last images that cannot be written wait in memory for another attempt.
  Results(const Job& job, const World& world, const OutputSettings& settings, const OtherFiles& others,
          bool keep_failed, Messages& messages, Video::EndWanted end_wanted);

  std::size_t bytes_while_writing() const { return output_.bytes_while_writing(); }
  /// The images of an interval's frames, `seconds` after its begin; the last ones go to the video, too.
  void write(const FrameList& interval, const Integrator& integrator, double seconds, Images images);
  /// Writes another file of the run; see WriteFaults.
  void attempt(const std::filesystem::path& file, const WriteFaults::Write& write) { faults_.attempt(file, write); }
  void tell_faults() { faults_.tell(); }
  void tell_missing() const { faults_.tell_end(); }
  bool are_whole() const { return !faults_.any(); }

  void say_end(double seconds, bool interrupted) const;
  /// The statistics and the video. Whether all files are written.
  bool finish(const RunReport& report);

 private:
  const Job& job_;
  const World& world_;
  const OutputSettings settings_;
  bool keep_failed_;
  Messages& messages_;
  WriteFaults faults_;
  Output output_;
  std::set<Frame> written_;  // frames that have images, as far as files can be written
};

}  // namespace dspm
