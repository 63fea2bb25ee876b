// The textures that a GPU shares with the CPU: values in memory, some of which point to others, looked up at a point.
#include "words.h"

#include "dspm/base/colour/rgb.h"
#include "dspm/textures/plain_texture.h"

extern "C" __global__ void textures(const dspm::PlainTexture<dspm::Rgb>* colour, const dspm::PlainTexture<float>* number,
                                    const dspm::PlainPlace* place, dspm::Rgb* colour_there, float* number_there) {
  *colour_there = colour->at(*place);
  *number_there = number->at(*place);
}
