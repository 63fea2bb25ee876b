#include "dspm/testing/promises.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/image/image.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/scene/scene.h"

namespace dspm::test {
namespace {

std::vector<Image> images_of(const Integrator& integrator, const Scene& scene) {
  std::vector<Image> images;
  for (Frame frame = 0; frame < scene.frame_count(); ++frame) images.push_back(integrator.estimate(frame));
  return images;
}

/// Runs `before` iterations on one integrator, the others on another one that takes over its state.
Verdict check_resume(TestScene& test, Scene& scene, int before, int iterations, const std::vector<Image>& expected) {
  const auto first = test.integrator(scene), second = test.integrator(scene);
  test.iterate(*first, scene, 0, before);
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  try {
    second->persist(state);
  } catch (const std::runtime_error& error) {
    return {false, fmt::format("its state after iteration {} cannot be loaded: {}", before, error.what())};
  }
  if (!state.all_read()) return {false, "persist() loads less than it saves"};
  test.iterate(*second, scene, before, iterations);
  if (images_of(*second, scene) != expected)
    return {false, fmt::format("resumed after iteration {}, it gives different bits", before)};
  return {};
}

/// Allows what a different order of sums may change, and no more.
bool near(const Rgb& a, const Rgb& b) {
  constexpr float kRounding = 1e-5f, kDark = 1e-3f;  // as sums in single precision have it; of darker pixels, too
  const float scale = std::max({kDark, max_component(a), max_component(b)});
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(a[c] - b[c]) <= kRounding * scale)) return false;
  return true;
}

std::string in_words(const Rgb& c) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", c.r, c.g, c.b); }

}  // namespace

Verdict check_threads(const std::string& scene, int iterations) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return TestScene(scene).render_all(iterations);
  };
  Verdict verdict;
  const std::vector<Image> alone = with(1);
  for (const int threads : {2, 5})
    if (with(threads) != alone) verdict.fail(fmt::format("{} threads give different bits than one", threads));
  return verdict;
}

Verdict check_resume(const std::string& scene, int iterations) {
  TestScene test(scene);
  Verdict verdict;
  for (const std::vector<FileFrame>& frames : test.intervals()) {
    const auto interval = test.scene(frames);
    const auto calm = test.integrator(*interval);
    test.iterate(*calm, *interval, 0, iterations);
    if (CountingStream size; !calm->persist(size))
      return {false, "persist() says that it does not support checkpoints"};
    const std::vector<Image> expected = images_of(*calm, *interval);
    for (int before = 1; before < iterations && verdict.passed; ++before)
      verdict = check_resume(test, *interval, before, iterations, expected);
  }
  return verdict;
}

Verdict check_joint(const std::string& scene, int iterations) {
  TestScene test(scene);
  Verdict verdict;
  if (test.frame_count() < 2) verdict.fail("the scene has only one frame");
  const std::vector<Image> joint = test.render_all(iterations);
  for (const FileFrame frame : test.all_frames()) {
    const Image &a = joint[frame.slot()], b = test.render(frame, iterations);
    for (std::size_t i = 0; i < b.pixels.size(); ++i)
      if (!near(a.pixels[i], b.pixels[i]))
        verdict.fail(fmt::format("frame {} of the joint render has {} in pixel {}, alone {}", frame.index() + 1,
                                 in_words(a.pixels[i]), i, in_words(b.pixels[i])));
  }
  return verdict;
}

Verdict check_crop(const std::string& scene, int iterations) {
  TestScene whole(scene);
  const PixelRect all = whole.job().settings.crop;
  Choices choices;
  const int x = all.width() / 4, y = all.height() / 4;
  choices.pixel_bounds = {all.x0 + x, all.x1 - x / 2, all.y0 + y, all.y1 - y / 2};
  Verdict verdict;
  const std::vector<Image> images = whole.render_all(iterations);
  const std::vector<Image> crops = TestScene(scene, choices).render_all(iterations);
  for (std::size_t frame = 0; frame < crops.size(); ++frame)
    for (int row = 0; row < crops[frame].height; ++row)
      for (int column = 0; column < crops[frame].width; ++column) {
        const Rgb &a = images[frame].at(column + x, row + y), &b = crops[frame].at(column, row);
        if (!near(a, b))
          verdict.fail(fmt::format("frame {}, pixel {}, {}: {} in the whole image, {} in a crop", frame + 1, column + x,
                                   row + y, in_words(a), in_words(b)));
      }
  return verdict;
}

}  // namespace dspm::test
