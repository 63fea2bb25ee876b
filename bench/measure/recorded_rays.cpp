#include "bench/measure/recorded_rays.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "dspm/accel/accel.h"

namespace dspm {
namespace {

/// The rays of all threads, in the order in which they come.
class Recording {
 public:
  explicit Recording(std::size_t most) : rays_(most) {}

  void add(const Ray& ray, FrameSet frames) {
    const std::size_t at = count_++;
    if (at < rays_.size()) rays_[at] = {ray, frames};
  }
  std::vector<AskedRay> take() {
    rays_.resize(std::min(rays_.size(), count_.load()));
    return std::move(rays_);
  }

 private:
  std::vector<AskedRay> rays_;
  std::atomic<std::size_t> count_ = 0;
};

class Recorder final : public Accel {
 public:
  Recorder(const Accel& accel, Recording& nearest, Recording& shadow)
      : accel_(accel), nearest_(nearest), shadow_(shadow) {}

  HitPartition partition(const Ray& ray, FrameSet frames) const override {
    nearest_.add(ray, frames);
    return accel_.partition(ray, frames);
  }
  FrameSet occluded(const Ray& ray, FrameSet frames) const override {
    shadow_.add(ray, frames);
    return accel_.occluded(ray, frames);
  }
  std::size_t memory() const override { return accel_.memory(); }

 private:
  const Accel& accel_;
  Recording &nearest_, &shadow_;
};

}  // namespace

RecordedRays record(const Run& run, int iteration, std::size_t most) {
  Recording nearest(most), shadow(most);
  std::unique_ptr<Accel> own = std::move(run.scene->accel);
  run.scene->accel = std::make_unique<Recorder>(*own, nearest, shadow);
  run.integrator->iterate({iteration, *run.scene});
  run.scene->accel = std::move(own);
  return {nearest.take(), shadow.take()};
}

}  // namespace dspm
