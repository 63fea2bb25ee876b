// What the tests of vectors of motion share.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test::motion_vectors {

inline constexpr int kWidth = 32, kHeight = 16;

inline Choices asking(std::vector<std::string> outputs = {"motion"}) {
  Choices choices;
  choices.outputs = std::move(outputs);
  return choices;
}

/// By output, then by frame.
using Vectors = std::map<std::string, std::vector<Image>>;

inline Vectors vectors_of(TestScene& test, const std::vector<FileFrame>& frames, int iterations = 4) {
  Vectors vectors;
  const auto scene = test.scene(frames);
  const auto integrator = test.integrator(*scene);
  test.iterate(*integrator, *scene, 0, iterations);
  for (const std::string& output : test.job().settings.outputs)
    for (Frame f = 0; f < scene->frame_count(); ++f) vectors[output].push_back(integrator->estimate(f, output));
  return vectors;
}

inline Vectors vectors_of(const std::string& text, const std::string& name = "test.dsc", int iterations = 4) {
  TestScene test(text, asking(), name);
  return vectors_of(test, test.all_frames(), iterations);
}

struct Expected {
  double u, v;
};

inline void expect(const Vectors& vectors, const char* direction, int frame, int x, int y, const Expected& expected,
                   double tolerance = 2e-3) {
  const Rgb& value = vectors.at(std::string("motion.") + direction)[static_cast<std::size_t>(frame)].at(x, y);
  SCOPED_TRACE(fmt::format("{}, frame {}, pixel {}, {}", direction, frame, x, y));
  EXPECT_NEAR(static_cast<double>(value.r), expected.u, tolerance);
  EXPECT_NEAR(static_cast<double>(value.g), expected.v, tolerance);
}

/// Where the middle of a pixel is, in pixels to the right and up of the picture's middle.
inline double right(int x) { return x + 0.5 - kWidth / 2.; }
inline double up(int y) { return kHeight / 2. - y - 0.5; }

}  // namespace dspm::test::motion_vectors
