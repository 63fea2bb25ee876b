#include "dspm/testing/test_scene.h"

#include <numeric>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/session/exposure.h"
#include "dspm/session/load.h"
#include "dspm/session/stage.h"
#include "dspm/world/scene/scene.h"

namespace dspm::test {

struct TestScene::Impl {
  Diagnostics diagnostics;
  LoadedScene loaded;

  Impl(const std::string& name, std::string text, const Choices& choices)
      : loaded(name, std::move(text), choices, diagnostics) {}
};

TestScene::TestScene(std::string text, const std::string& name) : TestScene(std::move(text), Choices{}, name) {}
TestScene::TestScene(std::string text, const Choices& choices, const std::string& name)
    : impl_(std::make_unique<Impl>(name, std::move(text), choices)) {}
TestScene::~TestScene() = default;

const Job& TestScene::job() const { return impl_->loaded.job; }
const World& TestScene::world() const { return *impl_->loaded.world; }

int TestScene::frame_count() const { return job().description->frames.count(); }

std::vector<FileFrame> TestScene::all_frames() const {
  std::vector<FileFrame> frames(static_cast<std::size_t>(frame_count()));
  std::iota(frames.begin(), frames.end(), FileFrame(0));
  return frames;
}

std::vector<std::vector<FileFrame>> TestScene::intervals() const {
  if (job().plugin->frames_together > 1) return {all_frames()};
  std::vector<std::vector<FileFrame>> alone;
  for (const FileFrame frame : all_frames()) alone.push_back({frame});
  return alone;
}

std::unique_ptr<Scene> TestScene::scene(const std::vector<FileFrame>& frames) const { return world().scene(frames); }

std::unique_ptr<Integrator> TestScene::integrator(const Scene& scene, const std::string& name, std::size_t memory) {
  Job job = this->job();
  if (!name.empty()) job.plugin = integrator_plugins().find(name), job.integrator = name;
  auto made = make_integrator(job, scene, impl_->diagnostics, memory);
  impl_->diagnostics.throw_if_errors();
  return made;
}

void TestScene::iterate(Integrator& integrator, Scene& scene, int first, int end) const {
  Exposure exposure(job(), world(), scene);
  for (int i = first; i < end; ++i) integrator.iterate(exposure.iteration(i));
}

Image TestScene::render(FileFrame frame, int iterations, const std::string& name) {
  const auto alone = scene({frame});
  const auto made = integrator(*alone, name);
  iterate(*made, *alone, 0, iterations);
  return made->estimate(0);
}

std::vector<Image> TestScene::render_all(int iterations) {
  std::vector<Image> images;
  for (const std::vector<FileFrame>& frames : intervals()) {
    const auto together = scene(frames);
    const auto made = integrator(*together);
    iterate(*made, *together, 0, iterations);
    for (Frame frame = 0; frame < together->frame_count(); ++frame) images.push_back(made->estimate(frame));
  }
  return images;
}

void TestScene::set_seed(std::uint64_t seed) { impl_->loaded.job.settings.seed = seed; }

}  // namespace dspm::test
