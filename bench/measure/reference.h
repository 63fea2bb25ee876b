// What a picture should be, by long runs: of path and vcm where path finds all light, of vcm everywhere else. Not of
// dsppm: what its guide misses for long would be missing here, too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/measure/convergence.h"
#include "dspm/image/film/pixel_rect.h"
#include "dspm/image/image.h"

namespace dspm {

/// Of each frame, squares of pixels, row by row: true for those that belong to the part.
struct Part {
  int columns = 0, rows = 0;
  std::vector<std::vector<bool>> frames;

  /// The one of a pixel, whatever the image's resolution.
  std::size_t square(const Image& image, int x, int y) const;
  bool holds(std::size_t frame, const Image& image, int x, int y) const;
  /// Of all squares.
  double share() const;
  Part rest() const;
};

/// The squares of 8 x 8 pixels of which the rectangle holds any.
Part squares_in(const PixelRect& pixels, const Images& images);

/// The images with one pixel for each square of 8 x 8: noise between neighbours is gone, blotches stay.
Images in_blocks(const Images& images);

/// error_of, of the pixels in the part alone; 0 if there are none. Darkness is still relative to the whole picture.
double error_of(const Images& images, const Images& truth, const Part& part);

/// The blocks of path's picture whose error is at most 10%.
Part agreement(const Images& path, const Images& truth);

struct Reference {
  Images truth;
  Part seen, hidden;                        // what path finds, and what it does not
  double uncertain_seen, uncertain_hidden;  // half the difference of the runs, in blocks
};

/// A scene, loaded for integrators that take different parameters.
struct Comparison {
  LoadedScene path, dsppm, vcm;

  Comparison(const std::filesystem::path& file, Choices choices);
  const LoadedScene& of(const std::string& integrator) const;
};

/// Three runs of that many seconds each, with seeds that no comparison uses.
Reference make_reference(const Comparison& scene, double seconds);

}  // namespace dspm
