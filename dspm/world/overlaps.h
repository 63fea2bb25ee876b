// Bodies that overlap although nothing says which of them is there.
#pragma once

#include <vector>

#include "dspm/math/frames.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// Two shapes that can meet, and the box in which they can.
struct Neighbours {
  int a, b;  // into the scene's shapes
  Bounds3 common;
};

/// Pairs of bodies of which nothing says which is there, as far as their boxes tell. The scene needs no accelerator.
std::vector<Neighbours> neighbours(const Scene& bodies);

/// A place where two bodies overlap.
struct Overlap {
  int entered_first, entered_second;  // shapes, by the ray that has found it
  FrameSet frames;
  Vec3 place;
  float depth = 0;  // along the ray
};

/// The overlaps that rays through these boxes find, each pair of shapes at its deepest. A body that lies wholly within
/// another one does not overlap it. The scene's shapes are all bodies.
std::vector<Overlap> find_overlaps(const Scene& bodies, const std::vector<Neighbours>& pairs);

/// Of the two shapes' bodies in these frames: those in which neither has the higher priority, or the higher one hides
/// where the other one would have to scatter light.
FrameSet undecided(const Scene& bodies, int shape, int other, FrameSet frames);

}  // namespace dspm
