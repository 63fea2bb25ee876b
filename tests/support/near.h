// Vectors that are nearly equal.
#pragma once

#include <gtest/gtest.h>

#include "dspm/base/math/vec.h"

namespace dspm::test {

inline void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  EXPECT_LT(max_component(abs(a - b)), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

}  // namespace dspm::test
