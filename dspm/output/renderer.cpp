#include "dspm/output/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "dspm/math/frames.h"
#include "dspm/output/developed.h"
#include "dspm/scene/scene.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/session.h"
#include "dspm/system/state_in_memory.h"

namespace dspm {
namespace {

class CalledMessages final : public Messages {
 public:
  explicit CalledMessages(const Warn& warn) : Messages(true), warn_(warn) {}

 protected:
  void print(std::string_view text) const override { warn_(std::string(text)); }

 private:
  const Warn& warn_;
};

}  // namespace

std::shared_ptr<const LoadedScene> load_scene(const std::vector<std::string>& files, const Choices& choices,
                                              const Warn& warn) {
  CalledMessages messages(warn);
  Choices without_file = choices;
  without_file.outfile = "image.exr";  // it is never written, and no other kind of file limits the outputs
  return std::make_shared<const LoadedScene>(files, without_file, messages);
}

struct Renderer::Impl {
  void persist(StateStream& stream) {
    stream.value(iterations);
    for (const Interval& interval : intervals)
      if (!interval.integrator->persist(stream)) throw std::runtime_error("this integrator has no state to keep");
  }

  struct Interval {
    std::unique_ptr<const Scene> scene;
    std::unique_ptr<Integrator> integrator;
  };
  struct Place {
    std::size_t interval;
    Frame frame;
  };

  void make(const FrameList& frames, Messages& messages) {
    Interval interval;
    interval.scene = scene->world->scene(frames);
    interval.integrator = make_integrator(scene->job, *interval.scene, messages);
    const FrameList& all = scene->job.frames;
    for (std::size_t j = 0; j < frames.size(); ++j) {
      const auto at = std::lower_bound(all.begin(), all.end(), frames[j]) - all.begin();
      places[static_cast<std::size_t>(at)] = {intervals.size(), static_cast<Frame>(j)};
    }
    intervals.push_back(std::move(interval));
  }

  std::shared_ptr<const LoadedScene> scene;
  std::vector<std::string> labels = {}, outputs = {kRadiance};
  std::vector<Interval> intervals = {};
  std::vector<Place> places = {};  // by frame
  int iterations = 0;
};

Renderer::Renderer(std::shared_ptr<const LoadedScene> scene, const Warn& warn)
    : impl_(std::make_unique<Impl>(Impl{std::move(scene)})) {
  const SceneDescription& description = *impl_->scene->description;
  const Job& job = impl_->scene->job;
  for (const FileFrame frame : job.frames) impl_->labels.push_back(description.frames.label(frame));
  for (const std::string& output : job.outputs) impl_->outputs.push_back(output);
  impl_->places.resize(job.frames.size());
  CalledMessages messages(warn);
  const int together = std::min(job.plugin->frames_together, kMaxFrames);
  for (const FrameList& frames : FrameIntervals(description, job.frames).cut(together)) impl_->make(frames, messages);
}

Renderer::~Renderer() = default;

const std::vector<std::string>& Renderer::labels() const { return impl_->labels; }

void Renderer::iterate() {
  for (const Impl::Interval& interval : impl_->intervals)
    interval.integrator->iterate(impl_->iterations, *interval.scene);
  ++impl_->iterations;
}

int Renderer::iterations() const { return impl_->iterations; }
int Renderer::wanted() const { return impl_->scene->job.iterations(*impl_->intervals.front().integrator); }

const std::vector<std::string>& Renderer::outputs() const { return impl_->outputs; }

Image Renderer::image(int frame, const std::string& output) const {
  if (frame < 0 || frame >= static_cast<int>(impl_->places.size()))
    throw std::out_of_range(fmt::format("frame {}: there are {}, counted from 0", frame, impl_->places.size()));
  if (std::find(impl_->outputs.begin(), impl_->outputs.end(), output) == impl_->outputs.end())
    throw std::out_of_range(
        fmt::format("\"{}\" is none of the outputs that were asked for: {}", output, fmt::join(impl_->outputs, ", ")));
  const Impl::Place place = impl_->places[static_cast<std::size_t>(frame)];
  Image image = impl_->intervals[place.interval].integrator->estimate(place.frame, output);
  return output == kRadiance ? developed(std::move(image), impl_->scene->job) : image;
}

std::vector<Statistics> Renderer::statistics() const {
  std::vector<Statistics> all;
  for (const Impl::Interval& interval : impl_->intervals) all.push_back(interval.integrator->statistics());
  return all;
}

std::string Renderer::state() const { return state_of(*impl_); }

void Renderer::load_state(std::string_view state) {
  LoadedState stream(state);
  impl_->persist(stream);
  if (!stream.all_read()) throw std::runtime_error("the state of a renderer has fewer bytes");
}

}  // namespace dspm
