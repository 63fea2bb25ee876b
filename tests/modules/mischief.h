// What tests expect of a run with the module "mischief" (samples/mischief.cpp).
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {

inline void expect_contains(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << "no \"" << piece << "\" in:\n" << text;
}

/// The images of the scene tiny.dsc, each frame in its own grey.
inline void expect_paintings(const TinyDirectory& directory) {
  for (int frame = 1; frame <= 3; ++frame)
    EXPECT_EQ(read_image(directory / ("tiny.000" + std::to_string(frame) + ".exr")).at(5, 5),
              Rgb(0.25f * static_cast<float>(frame)));
}

}  // namespace dspm::test
