#include "dspm/integrators/transport/left_in_media.h"

#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/integrators/transport/medium_boundary.h"

namespace dspm {
namespace {

constexpr int kMostBoundaries = 256;

/// A way from the segment's start through one medium after another.
class Passage {
 public:
  Passage(const Scene& scene, FrameArray<FrameFactor>& left) : scene_(scene), left_(left) {}

  void follow(const Ray& ray, int medium, FrameSet frames, const Spectrum& factor, const SegmentNumbers& numbers,
              int boundaries) {
    for (const Meeting& meeting : boundaries_along(scene_, ray, frames)) {
      for_each_state(medium, meeting.frames, [&](FrameSet common, const Medium* state, const Majorants* majorants) {
        SegmentNumbers own = numbers;
        const float distance = meeting.is_boundary ? meeting.hit.t : ray.t_max;
        const Spectrum after = state == nullptr ? factor : factor * left_in(*state, *majorants, ray, distance, own);
        if (is_black(after)) return;
        if (!meeting.is_boundary) return static_cast<void>(left_.add({common, after}));
        if (boundaries == kMostBoundaries) return;
        const BoundaryPoint point(*scene_.boundaries, meeting.hit, ray.direction);
        follow(point.beyond(ray, distance), point.medium_beyond(ray.direction), common, after, own, boundaries + 1);
      });
    }
  }

 private:
  template <class Fn>
  void for_each_state(int medium, FrameSet frames, Fn&& fn) {
    if (medium == kNoMedium)
      return fn(frames, static_cast<const Medium*>(nullptr), static_cast<const Majorants*>(nullptr));
    const SceneMedium& known = scene_.media[static_cast<std::size_t>(medium)];
    known.majorants.for_each(frames, [&](FrameSet alike, const Majorants& majorants) {
      known.states.for_each(alike, [&](FrameSet common, const Medium& state) { fn(common, &state, &majorants); });
    });
  }

  Spectrum left_in(const Medium& state, const Majorants& majorants, const Ray& ray, float distance,
                   SegmentNumbers& numbers) {
    steps_.clear();
    MediumPassage passage(state, majorants, *scene_.palette, ray, numbers, steps_);
    passage.advance(distance);
    return passage.left();
  }

  const Scene& scene_;
  FrameArray<FrameFactor>& left_;
  std::vector<MediumStep> steps_;
};

}  // namespace

FrameArray<FrameFactor> left_in_media(const Scene& scene, const Ray& segment, int medium, FrameSet frames,
                                      const SegmentNumbers& numbers) {
  FrameArray<FrameFactor> left;
  if (medium == kNoMedium && scene.boundaries == nullptr) {
    left.add({frames, Spectrum(1)});
    return left;
  }
  Passage(scene, left).follow(segment, medium, frames, Spectrum(1), numbers, 0);
  return left;
}

}  // namespace dspm
