// All frames of a scene, rendered together with images in memory: what Renderer and the Python module stand on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/math/frames.h"
#include "dspm/output/output.h"
#include "dspm/output/renderer.h"
#include "dspm/scene/scene.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/load.h"
#include "dspm/system/state_stream.h"

namespace dspm {

/// Which files JointRender::write makes.
struct ImageFiles {
  std::string outfile;      // as of --outfile
  std::vector<int> frames;  // ascending; empty: all
  std::optional<bool> half;
  OutputSettings settings;
};

/// See Renderer for what is not said here. Intervals of frames are all in memory.
class JointRender {
 public:
  explicit JointRender(std::shared_ptr<const LoadedScene> scene, const Warn& warn = kIgnoreWarnings);

  const LoadedScene& scene() const { return *scene_; }
  const std::vector<std::string>& labels() const { return labels_; }
  const std::vector<std::string>& outputs() const { return outputs_; }
  void iterate();
  int iterations() const { return iterations_; }
  int wanted() const;
  /// Throws std::out_of_range as Renderer's, and std::logic_error before the first iteration.
  Image image(int frame, const std::string& output = kRadiance) const;
  /// Radiance with less noise. Throws UsageError if the scene was not loaded with a denoiser.
  Image denoised(int frame) const;
  /// Files with the bits of the program's. Returns their names. Throws UsageError for settings that make no sense, and
  /// std::runtime_error if a file cannot be written.
  std::vector<std::filesystem::path> write(const ImageFiles& files, const Warn& warn) const;
  std::vector<Statistics> statistics() const;
  std::string state();
  void load_state(std::string_view state);
  /// Of both.
  void persist(StateStream& stream);

 private:
  struct Interval {
    FrameList frames;
    std::unique_ptr<const Scene> scene;
    std::unique_ptr<Integrator> integrator;
  };
  struct Place {
    std::size_t interval;
    Frame frame;
  };

  void make(const FrameList& frames, Messages& messages);
  /// Throws unless there is such a frame, and an image of it.
  Place place_of(int frame) const;

  std::shared_ptr<const LoadedScene> scene_;
  std::vector<std::string> labels_, outputs_ = {kRadiance};
  std::vector<Interval> intervals_;
  std::vector<Place> places_;  // by frame
  int iterations_ = 0;
  double seconds_ = 0;  // that they took
};

/// Messages as warnings that a caller is shown.
class CalledMessages final : public Messages {
 public:
  explicit CalledMessages(const Warn& warn) : Messages(true), warn_(warn) {}

 protected:
  void print(std::string_view text) const override { warn_(std::string(text)); }

 private:
  const Warn& warn_;
};

}  // namespace dspm
