// The results of a run: images, contact sheet, video and statistics, and which of them could not be written.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/output/output.h"
#include "dspm/output/report/run_report.h"
#include "dspm/output/write_faults.h"
#include "dspm/session/observer.h"
#include "dspm/world/world.h"

namespace dspm {

class Results {
 public:
  using Images = SessionObserver::Images;

  /// Takes what Output takes. If `keep_failed`, memory is not bounded: last images that cannot be written stay in it for
  /// another attempt, and several are written at the same time.
  Results(const Job& job, const World& world, const OutputSettings& settings, const OtherFiles& others,
          bool keep_failed, Messages& messages, Video::EndWanted end_wanted);

  std::size_t bytes_while_writing() const { return output_.bytes_while_writing(); }
  /// Writes the images of those of an interval's frames that are the job's, `seconds` after its start; the last ones go to
  /// the video, too.
  void write(const FrameList& interval, const Integrator& integrator, double seconds, Images images);
  /// Writes another file of the run; see WriteFaults.
  void attempt(const std::filesystem::path& file, const WriteFaults::Write& write) { faults_.attempt(file, write); }
  void report_faults() { faults_.report(); }
  void report_missing() const { faults_.report_missing(); }
  bool are_whole() const { return !faults_.any(); }

  /// Returns the files that hold images: "a.0001.exr to a.0003.exr"; empty if there are none.
  std::string written() const;
  /// Of the frames that have images.
  std::vector<std::filesystem::path> files() const;
  void say_end(double seconds, bool interrupted) const;
  /// Writes the statistics, the table of images and the video. Returns whether all files are written.
  bool finish(const RunReport& report);

 private:
  struct FrameImages;
  std::size_t images_at_once(std::size_t count) const;
  void estimate(FrameImages& of_frame, const Integrator& integrator, const std::vector<OutputInfo>& outputs,
                Images images);
  /// Writes images of several frames at the same time, and those with less noise.
  void write_files(const std::vector<std::shared_ptr<FrameImages>>& frames, const Integrator& integrator,
                   Images images);
  /// Writes the table of the images, if one was asked for.
  void write_index() const;

  const Job& job_;
  const World& world_;
  const OutputSettings settings_;
  bool keep_failed_;
  Messages& messages_;
  WriteFaults faults_;
  Output output_;
  std::set<FileFrame> written_;  // frames that have images, unless their files cannot be written
};

}  // namespace dspm
