// What is promised of every integrator: the same bits with any number of threads and when it is resumed, equal frames
// where nothing differs, a crop that equals the same pixels of the whole, and memory that does not grow.
#include "dspm/testing/promises.h"

#include <gtest/gtest.h>

#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/random_scene.h"
#include "tests/support/seeds.h"

namespace dspm {
namespace promises_test {

using test::RandomScene;
using test::seeds;
using test::TestScene;

constexpr const char* kVariants[] = {
    R"("dsppm" "integer photons" 4000 "string estimator" "hj09")",
    R"("dsppm" "integer photons" 4000 "string direct" "photons")",
    R"("dsppm" "integer photons" 4000 "string estimator" "kz11" "string direct" "sampled")",
    R"("sppm" "integer photons" 4000 "string estimator" "hj09")",
    R"("sppm" "integer photons" 4000)",
    R"("photonmap" "integer photons" 4000 "integer causticphotons" 4000 "integer nearest" 20)",
    R"("photonmap" "integer photons" 4000 "integer causticphotons" 4000 "integer nearest" 20 "integer finalgather" 4)",
    R"("path" "integer maxdepth" 6)",
    R"("ambientocclusion" "float maxdistance" 1)",
    R"("vcm" "integer photons" 3000)",
    R"("vcm" "bool merge" false)",
};

class Promises : public ::testing::TestWithParam<const char*> {
 protected:
  std::string integrator() const { return std::string("Integrator ") + GetParam(); }
};

TEST_P(Promises, SameBitsWithAnyNumberOfThreads) {
  for (unsigned seed = 0; seed < static_cast<unsigned>(seeds(2)); ++seed) {
    const std::string text = RandomScene(seed, 5).text(integrator());
    SCOPED_TRACE(text);
    const test::Verdict verdict = test::check_threads(text, 2);
    EXPECT_TRUE(verdict.passed) << verdict.message;
  }
}

TEST_P(Promises, AnotherOneTakesOverToTheSameBits) {
  const std::string text = RandomScene(7, 5).text(integrator());
  SCOPED_TRACE(text);
  const test::Verdict verdict = test::check_resume(text, 4);
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

TEST_P(Promises, FramesOfAStaticSceneAreIdentical) {
  TestScene test(test::box("Frames 7\n" + integrator(), R"(
DynamicBegin "still"
  Translate 0.2 -0.6 0
  Material "dielectric"
  Shape "sphere" "float radius" 0.4
DynamicEnd)"));
  const std::vector<Image> images = test.render_all(2);
  ASSERT_EQ(images.size(), 7u);
  for (const Image& image : images) EXPECT_EQ(image, images.front());
}

TEST_P(Promises, ACropEqualsTheSamePixelsOfTheWhole) {
  const std::string text = RandomScene(17, 3).text(integrator());
  SCOPED_TRACE(text);
  const test::Verdict verdict = test::check_crop(text, 2);
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

TEST_P(Promises, MemoryIsFlatOverIterations) {
  TestScene test(test::box("Frames 3\n" + integrator(), R"(
DynamicBegin "ball"
  Keyframe 1 Translate -0.4 -0.6 0 Keyframe 3 Translate 0.4 -0.6 0 KeyframeEnd
  Material "dielectric"
  Shape "sphere" "float radius" 0.35
DynamicEnd)"));
  const auto scene = test.scene(test.intervals().front());
  const auto made = test.integrator(*scene);
  std::vector<std::size_t> bytes;
  for (int i = 0; i < 40; ++i) {
    made->iterate({i, *scene});
    bytes.push_back(made->statistics().bytes);
  }
  // Buffers settle within a few iterations; what grew with every iteration would be four times larger.
  EXPECT_LE(static_cast<double>(bytes[39]), 1.5 * static_cast<double>(bytes[9]));
}

TEST_P(Promises, NothingIsInvalid) {
  for (unsigned seed = 40; seed < 40 + static_cast<unsigned>(seeds(5)); ++seed) {
    const std::string text = RandomScene(seed, 2).text(integrator());
    SCOPED_TRACE(text);
    TestScene test(text);
    for (const Image& image : test.render_all(2))
      for (const Rgb& pixel : image.pixels) {
        ASSERT_TRUE(is_finite(pixel));
        ASSERT_GE(std::min(pixel.r, std::min(pixel.g, pixel.b)), 0);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Promises, ::testing::ValuesIn(kVariants));

}  // namespace promises_test
}  // namespace dspm
