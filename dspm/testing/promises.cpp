#include "dspm/testing/promises.h"

#include <fmt/format.h>

#include <stdexcept>

#include "dspm/image/image.h"
#include "dspm/math/frames.h"
#include "dspm/scene/scene.h"
#include "dspm/system/parallel.h"
#include "dspm/system/state_in_memory.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace {

std::vector<Image> images_of(const Integrator& integrator, const Scene& scene) {
  std::vector<Image> images;
  for (Frame frame = 0; frame < scene.frame_count(); ++frame) images.push_back(integrator.estimate(frame));
  return images;
}

void iterate(Integrator& integrator, int first, int end) {
  for (int i = first; i < end; ++i) integrator.iterate(i);
}

/// After so many iterations of one integrator, the others by another one that takes over its state.
Verdict check_resume(TestScene& test, const Scene& scene, int before, int iterations,
                     const std::vector<Image>& expected) {
  const auto first = test.integrator(scene), second = test.integrator(scene);
  iterate(*first, 0, before);
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  try {
    second->persist(state);
  } catch (const std::runtime_error& error) {
    return {false, fmt::format("its state after iteration {} cannot be loaded: {}", before, error.what())};
  }
  if (!state.all_read()) return {false, "persist() loads less than it saves"};
  iterate(*second, before, iterations);
  if (images_of(*second, scene) != expected)
    return {false, fmt::format("resumed after iteration {} it gives other bits", before)};
  return {};
}

}  // namespace

Verdict check_threads(const std::string& scene, int iterations) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return TestScene(scene).render_all(iterations);
  };
  Verdict verdict;
  const std::vector<Image> alone = with(1);
  for (const int threads : {2, 5})
    if (with(threads) != alone) verdict.fail(fmt::format("{} threads give other bits than one", threads));
  return verdict;
}

Verdict check_resume(const std::string& scene, int iterations) {
  TestScene test(scene);
  Verdict verdict;
  for (const std::vector<Frame>& frames : test.intervals()) {
    const auto interval = test.scene(frames);
    const auto calm = test.integrator(*interval);
    iterate(*calm, 0, iterations);
    if (CountingStream size; !calm->persist(size)) return {false, "persist() says that there are no checkpoints of it"};
    const std::vector<Image> expected = images_of(*calm, *interval);
    for (int before = 1; before < iterations && verdict.passed; ++before)
      verdict = check_resume(test, *interval, before, iterations, expected);
  }
  return verdict;
}

}  // namespace dspm::test
