// Do two integrators converge to the same picture? Both are rendered with several seeds, which gives the mean of every
// tile its standard error; Student's t-test says whether the difference is noise. So it needs neither a reference free
// of noise nor a guessed tolerance:
//
//   agreement(rendered("Integrator \"mine\"\n" + scene, 16), rendered("Integrator \"path\"\n" + scene, 64))
#pragma once

#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/testing/verdict.h"

namespace dspm::test {

/// The colours of the tiles of all frames, each frame's followed by that of its whole picture.
struct Tiles {
  struct Mean {
    double value = 0, variance = 0;  // of one colour; the variance is that of the mean
  };
  std::vector<Mean> means;
  int renders = 1;  // independent ones; 1 if the colours are known exactly
};

/// The images of all frames, by seed, in `across` x `across` tiles.
Tiles tiles_of(const std::vector<std::vector<Image>>& renders, int across = 4);

/// Renders all frames of a scene's text with that many seeds. Files that it names are looked for in the current folder.
/// What the integrator learns first, such as where photons start, it learns once: given the guides, the renders are
/// independent.
Tiles rendered(const std::string& scene, int iterations, int seeds = 16, int across = 4);

struct Tolerance {
  double level = 0.01;  // the chance that two with the same mean are told apart
  double bias = 0;      // fraction of the brightness that may differ in addition, as by the blur of photons
};
Verdict agreement(const Tiles& a, const Tiles& b, const Tolerance& tolerance = {});
/// Compares with a picture that has this colour everywhere.
Verdict agreement(const Tiles& a, const Rgb& everywhere, const Tolerance& tolerance = {});

/// The chance that Student's t exceeds `t` on either side.
double student_tails(double t, int degrees_of_freedom);

}  // namespace dspm::test
