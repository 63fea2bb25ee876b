// Accelerator "bruteforce"
//
// Tests every ray against every primitive of every frame: the trees must agree with it bit for bit. For tests and for
// reference images of tiny scenes; it has no parameters.
#pragma once

#include "dspm/accel/accel.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/params/params.h"

namespace dspm {

class BruteForce final : public Accel {
 public:
  explicit BruteForce(std::span<const PlacedShape> shapes) : shapes_(shapes) {}

  HitPartition partition(const Ray& ray, FrameSet frames) const override;
  FrameSet occluded(const Ray& ray, FrameSet frames) const override;
  std::size_t memory() const override { return sizeof(*this); }

 private:
  std::span<const PlacedShape> shapes_;
};

std::size_t brute_force_bytes(std::span<const PlacedShape> shapes, FrameSet all);
std::unique_ptr<Accel> make_brute_force(ParamReader& reader, std::span<const PlacedShape> shapes, FrameSet all);

}  // namespace dspm
