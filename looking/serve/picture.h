// One output of one frame as the page gets it: shrunk, as half or single floats, compressed.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

#include "dspm/image/image.h"
#include "dspm/integrators/output_info.h"

namespace dspm {

/// The picture that a viewer looks at.
struct Wish {
  int frame = 0;  // of the run, counted from 0
  std::string output = kRadiance;
  int halvings = 0;  // of the size

  friend auto operator<=>(const Wish&, const Wish&) = default;
};

struct Picture {
  Wish wish;
  int width = 0, height = 0;
  int channels = 3;
  int bytes = 2;  // of a value: 2 or 4
  int iterations = 0;
  int run = 0;                // counted from 1
  bool coarse = false;        // from the iterations before the first of the full size
  bool shrunk = false;        // more than was wished for
  std::uint64_t version = 0;  // grows with every picture
  std::string pixels;         // see packed()
};

/// Returns the bits of the nearest half float; ties go to even.
std::uint16_t half_of(float value);

/// Packs pixels in zlib's format. They go channel by channel, every value as the difference of its bits from those of
/// the pixel before, most significant bytes first, all of one significance together. Deflate finds little in noise
/// otherwise.
std::string packed(const Image& image, int channels, int bytes);

/// Makes a picture. Ids and what is declared to be in single precision stay so, and are not averaged.
Picture make_picture(const Wish& wish, const OutputInfo& output, Image image);

}  // namespace dspm
