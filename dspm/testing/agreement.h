// Do two integrators converge to the same picture? Both are rendered with several seeds, which gives the mean of every
// tile its standard error; Student's t-test says whether what remains is noise. So it takes no reference that is free
// of noise, and no tolerance that is guessed:
//
//   agreement(rendered("Integrator \"mine\"\n" + scene, 16), rendered("Integrator \"path\"\n" + scene, 64))
#pragma once

#include <string>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/testing/verdict.h"

namespace dspm::test {

/// The colours of the tiles of all frames, and at each frame's end of the whole picture.
struct Tiles {
  struct Mean {
    double value = 0, variance = 0;  // of one colour; the variance is that of the mean
  };
  std::vector<Mean> means;
  int renders = 1;  // independent ones: 1 for what is known exactly
};

/// The images of all frames, by seed, in `across` x `across` tiles.
Tiles tiles_of(const std::vector<std::vector<Image>>& renders, int across = 4);

/// All frames of a scene's text, in as many seeds. Files that it names are looked for in the current folder.
Tiles rendered(const std::string& scene, int iterations, int seeds = 16, int across = 4);

struct Tolerance {
  double level = 0.01;  // the chance that two of the same mean are told apart
  double bias = 0;      // share of the picture's brightness that may differ besides, as by the blur of photons
};
Verdict agreement(const Tiles& a, const Tiles& b, const Tolerance& tolerance = {});
/// With a picture that has this colour everywhere.
Verdict agreement(const Tiles& a, const Rgb& everywhere, const Tolerance& tolerance = {});

/// The chance that Student's t exceeds `t` on either side.
double student_tails(double t, int degrees_of_freedom);

}  // namespace dspm::test
