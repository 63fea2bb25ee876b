// All frames of a scene, rendered together with images in memory: what Renderer and the Python module stand on.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/load.h"
#include "dspm/session/messages.h"
#include "dspm/session/renderer.h"
#include "dspm/session/stage.h"

namespace dspm {

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
  /// The stage on which the frame is rendered, and the frame's number there. Throws as image() does.
  std::pair<const Stage&, Frame> place_of(int frame) const;
  /// One for each interval.
  const std::deque<Stage>& stages() const { return stages_; }
  /// How long all iterations took.
  double seconds() const { return seconds_; }
  std::vector<Statistics> statistics() const;
  std::string state();
  void load_state(std::string_view state);
  /// Of both.
  void persist(StateStream& stream);

 private:
  struct Place {
    std::size_t stage;
    Frame frame;
  };

  void make(const FrameList& frames, Messages& messages);

  std::shared_ptr<const LoadedScene> scene_;
  std::vector<std::string> labels_, outputs_ = {kRadiance};
  std::deque<Stage> stages_;
  std::vector<Place> places_;  // by frame
  int iterations_ = 0;
  double seconds_ = 0;
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
