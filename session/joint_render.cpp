#include "dspm/session/joint_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/image/image.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/developed.h"

namespace dspm {

JointRender::JointRender(std::shared_ptr<const LoadedScene> scene, const Warn& warn) : scene_(std::move(scene)) {
  const SceneDescription& description = *scene_->description;
  const Job& job = scene_->job;
  for (const FileFrame frame : job.frames) labels_.push_back(description.frames.label(frame));
  outputs_.insert(outputs_.end(), job.outputs.begin(), job.outputs.end());
  places_.resize(job.frames.size());
  CalledMessages messages(warn);
  const int together = std::min(job.plugin->frames_together, kMaxFrames);
  for (const FrameList& frames : FrameIntervals(description, job.frames).cut(together)) make(frames, messages);
}

void JointRender::make(const FrameList& frames, Messages& messages) {
  stages_.emplace_back(*scene_, frames).make_integrator(messages);
  const FrameList& all = scene_->job.frames;
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const auto at = std::lower_bound(all.begin(), all.end(), frames[j]) - all.begin();
    places_[static_cast<std::size_t>(at)] = {stages_.size() - 1, static_cast<Frame>(j)};
  }
}

void JointRender::iterate() {
  const auto begin = std::chrono::steady_clock::now();
  for (Stage& stage : stages_) stage.iterate(iterations_);
  ++iterations_;
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

int JointRender::wanted() const { return scene_->job.iterations(stages_.front().integrator()); }

std::pair<const Stage&, Frame> JointRender::place_of(int frame) const {
  if (frame < 0 || frame >= static_cast<int>(places_.size()))
    throw std::out_of_range(fmt::format("frame {}: there are {}, counted from 0", frame, places_.size()));
  if (iterations_ == 0) throw std::logic_error("there are no images before the first iteration");
  const Place& place = places_[static_cast<std::size_t>(frame)];
  return {stages_[place.stage], place.frame};
}

Image JointRender::image(int frame, const std::string& output) const {
  const auto& [stage, place] = place_of(frame);
  if (std::find(outputs_.begin(), outputs_.end(), output) == outputs_.end())
    throw std::out_of_range(
        fmt::format("\"{}\" is none of the outputs that were asked for: {}", output, fmt::join(outputs_, ", ")));
  Image image = stage.integrator().estimate(place, output);
  return output == kRadiance ? developed(std::move(image), scene_->job) : image;
}

std::vector<Statistics> JointRender::statistics() const {
  std::vector<Statistics> all;
  for (const Stage& stage : stages_) all.push_back(stage.integrator().statistics());
  return all;
}

void JointRender::persist(StateStream& stream) {
  stream.value(iterations_);
  for (const Stage& stage : stages_)
    if (!stage.integrator().persist(stream)) throw std::runtime_error("this integrator has no state to keep");
}

std::string JointRender::state() { return state_of(*this); }

void JointRender::load_state(std::string_view state) {
  LoadedState stream(state);
  persist(stream);
  if (!stream.all_read()) throw std::runtime_error("the state of a renderer has fewer bytes");
}

}  // namespace dspm
