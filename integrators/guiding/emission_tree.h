// Makes a guide of the photon paths that were found: a binary tree over the numbers of each light, finest where the
// paths that matter start. [Hachisuka and Jensen 2011; Müller et al. 2017]
#pragma once

#include <span>

#include "dspm/base/grid/buffer.h"
#include "dspm/integrators/photons/emission_guide.h"

namespace dspm {

/// A photon path that was found. `value` is the sum of the squares of what it would add to the pixels that found it if
/// it had been drawn with density 1, over the density with which the records were drawn.
struct EmissionRecord {
  int light;
  EmissionNumbers numbers;
  double value;
};

/// Memory for making a guide, which the next one uses again: pages that are new cost as much as half of the work.
struct GuideRoom {
  Buffer<EmissionRecord> spread, halves;
};

/// Makes a guide from the records, which come light by light and lose their order. `usual` holds the lights'
/// probabilities without a guide: a share of the paths keeps them, so no light is lost, whatever the records are.
EmissionGuide guide_from(std::span<EmissionRecord> records, std::span<const float> usual, GuideRoom& room);
EmissionGuide guide_from(std::span<EmissionRecord> records, std::span<const float> usual);

}  // namespace dspm
