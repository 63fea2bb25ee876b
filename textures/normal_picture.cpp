#include "dspm/textures/normal_picture.h"

#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/image.h"

namespace dspm {

bool holds_normals(const std::filesystem::path& picture) try {
  constexpr int kAlongSide = 32;
  constexpr float kTolerance = 0.15f, kMost = 0.95f;
  const Image image = read_image(picture, {ColorEncoding::Kind::linear});
  int normals = 0;
  for (int y = 0; y < kAlongSide; ++y)
    for (int x = 0; x < kAlongSide; ++x) {
      const Rgb c = image.at(x * image.width / kAlongSide, y * image.height / kAlongSide);
      const Vec3 n{2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1};
      const bool is_grey = c.r == c.g && c.g == c.b;
      normals += !is_grey && n.z > 0 && std::abs(length(n) - 1) < kTolerance;
    }
  return static_cast<float>(normals) >= kMost * kAlongSide * kAlongSide;
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace dspm
