#include "testing/promises.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/parallel.h"
#include "testing/state_bytes.h"
#include "testing/test_scene.h"

namespace dspm::test {
namespace {

std::vector<Image> images_of(const Integrator& integrator, const Scene& scene) {
  std::vector<Image> images;
  for (Frame frame = 0; frame < scene.frame_count(); ++frame) images.push_back(integrator.estimate(frame));
  return images;
}

struct BrokenState : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void load(Integrator& integrator, const std::string& bytes) try {
  LoadedState state(bytes);
  integrator.persist(state);
  if (!state.all_read()) throw BrokenState("persist() loads less than it saves");
} catch (const std::runtime_error& error) {
  throw BrokenState(fmt::format("its state cannot be loaded: {}", error.what()));
}

void iterate(Integrator& integrator, int first, int end) {
  for (int i = first; i < end; ++i) integrator.iterate(i);
}

/// After so many iterations of one integrator, the others by another one.
std::vector<Image> resumed(TestScene& test, const Scene& scene, int before, int iterations) {
  const auto first = test.integrator(scene), second = test.integrator(scene);
  iterate(*first, 0, before);
  load(*second, state_of(*first));
  iterate(*second, before, iterations);
  return images_of(*second, scene);
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

Verdict check_resume(const std::string& scene, int iterations) try {
  Verdict verdict;
  TestScene test(scene);
  for (const std::vector<Frame>& frames : test.intervals()) {
    const auto interval = test.scene(frames);
    const auto calm = test.integrator(*interval);
    iterate(*calm, 0, iterations);
    if (state_of(*calm).empty()) verdict.fail("there is no state of it: persist() is missing");
    const std::vector<Image> expected = images_of(*calm, *interval);
    for (int before = 1; before < iterations && verdict.passed; ++before)
      if (resumed(test, *interval, before, iterations) != expected)
        verdict.fail(fmt::format("resumed after iteration {} it gives other bits", before));
  }
  return verdict;
} catch (const BrokenState& error) {
  return {false, error.what()};
}

}  // namespace dspm::test
