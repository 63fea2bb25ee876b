// A square of an image together with its surroundings, plane by plane, as the joint filter reads them.
#pragma once

#include <array>
#include <vector>

namespace dspm {

/// The planes of an image: the first three are averaged, the others are compared.
enum Plane {
  kRed,
  kGreen,
  kBlue,
  kVariance,  // of the three together
  kNormalX,
  kNormalY,
  kNormalZ,
  kNearness,  // 1 / depth, which is linear over a plane's image; 0: no surface
  kSlope,     // its least change to a neighbouring pixel
  kPlanes
};

/// The planes of a whole image, row by row.
struct Planes {
  int width = 0, height = 0;
  std::array<std::vector<float>, kPlanes> values;
};

struct Offset {
  int x, y;
};

/// The weighted sums of a tile's pixels.
class Tile {
 public:
  static constexpr int kSide = 32;
  static constexpr int kReach = 8;  // of offsets, in pixels

  /// Takes the pixels from (x, y) on. The image's border is repeated beyond it, for comparisons only.
  Tile(const Planes& planes, int x, int y);
  /// Adds to the sums of every pixel the one at that offset from it, weighted by how alike both are.
  void add(Offset offset);
  /// Returns the mean for a pixel in that row and column of the tile, in one of the first three planes.
  float mean(Plane plane, int row, int column) const;
  /// Returns whether a pixel is a mean of several.
  bool is_mixed(int row, int column) const;

 private:
  static constexpr int kPatch = 2;  // pixels are compared together with so many around them
  static constexpr int kMargin = kReach + kPatch, kWidth = kSide + 2 * kMargin, kCompared = kSide + 2 * kPatch;
  static constexpr int kWeight = 3;  // the sum of weights, after those of the planes

  void compare(Offset offset);
  void add_row(int row, Offset offset);
  const float* at(Plane plane, int row, int column) const {
    return &planes_[static_cast<std::size_t>(plane)]
                   [static_cast<std::size_t>((row + kMargin) * kWidth + column + kMargin)];
  }

  std::array<std::vector<float>, kPlanes> planes_;
  std::vector<float> inside_;                             // the image: 1; its continuation: 0
  std::array<float, kCompared * kCompared> differences_;  // of single pixels
  std::array<float, kCompared * kSide> of_rows_;          // sums over the rows of patches
  std::array<std::array<float, kSide * kSide>, kWeight + 1> sums_ = {};
};

}  // namespace dspm
