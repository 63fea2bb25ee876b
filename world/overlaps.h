// Bodies that overlap although nothing says which of them is there.
#pragma once

#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Two shapes that can meet, and the box in which they can.
struct Neighbours {
  int a, b;  // into the scene's shapes
  Bounds3 common;
};

/// Returns the pairs of bodies whose boxes meet, if nothing says which of the two is there. The scene needs no
/// accelerator.
std::vector<Neighbours> neighbours(const Scene& bodies);

/// A place where two bodies overlap.
struct Overlap {
  int entered_first, entered_second;  // shapes, by the ray that has found it
  FrameSet frames;
  Vec3 place;
  float depth = 0;  // along the ray
};

/// Returns the overlaps that rays through these boxes find, each pair of shapes at its deepest. A body that lies wholly
/// within another one does not overlap it. The scene's shapes are all bodies.
std::vector<Overlap> find_overlaps(const Scene& bodies, const std::vector<Neighbours>& pairs);

/// Returns the frames in which neither shape's body has the higher priority, or the higher one hides where the other
/// one would have to scatter light.
FrameSet undecided(const Scene& bodies, int shape, int other, FrameSet frames);

}  // namespace dspm
