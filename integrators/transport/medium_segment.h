// A segment of a path through media, up to what it meets in each frame: surfaces, and boundaries without a surface, which no
// tracer knows of. A tracer either has
//   void collided(const Path&, const MediumVertex&)    may push branches
//   void glowed(const Path&, FrameSet, const Spectrum&)     optional: what the medium adds, for each unit of throughput
// or, for paths that pass straight through and are dimmed,
//   void beamed(const Path&, const MediumSection&)
// To others media are not there.
#pragma once

#include <cstddef>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/medium_boundary.h"
#include "dspm/integrators/transport/medium_flight.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A friend of the path's branches.
template <class Branches>
class MediumSegment {
 public:
  using Path = typename Branches::Path;

  /// `steps` is memory to work with.
  MediumSegment(Branches& branches, const Path& path, std::vector<MediumStep>& steps)
      : branches_(branches),
        scene_(branches.scene_),
        path_(path),
        meetings_(meetings_along(scene_, path.ray, path.frames)),
        steps_(steps) {}

  template <class Tracer>
  void follow(Tracer& tracer) {
    branches_.parted_ |= meetings_.size() > 1 || path_.frames != branches_.frames_;
    if constexpr (requires(const MediumSection& section) { tracer.beamed(path_, section); }) {
      if (path_.inside.medium != kNoMedium) return pass(tracer);
    } else if constexpr (requires(const MediumVertex& vertex) { tracer.collided(path_, vertex); }) {
      if (path_.inside.medium != kNoMedium) return fly(tracer);
    }
    for (const Meeting& meeting : meetings_) {
      Path on = path_;
      on.frames = meeting.frames;
      land(on, meeting, tracer);
    }
  }

 private:
  const SceneMedium& medium() const { return scene_.media[static_cast<std::size_t>(path_.inside.medium)]; }

  template <class Tracer>
  void fly(Tracer& tracer) {
    medium().majorants.for_each(path_.frames, [&](FrameSet frames, const Majorants& majorants) {
      MediumFlight flight(scene_, path_, frames, majorants);
      for (const Meeting& meeting : meetings_) {
        while (!flight.flying().empty() && flight.meet(meeting.hit.t)) collide(flight, tracer);
        for (const Flying& each : flight.flying())
          if (const FrameSet landing = each.frames & meeting.frames; !landing.empty())
            land(flown(each, landing, flight.numbers(), tracer), meeting, tracer);
        flight.land(meeting.frames);
      }
    });
  }

  template <class Tracer>
  Path flown(const Flying& flying, FrameSet frames, int numbers, Tracer& tracer) const {
    Path on = path_;
    on.frames = frames, on.throughput *= flying.weight, on.flights = {flying.share, numbers};
    if constexpr (requires { tracer.wandered(path_, on); }) tracer.wandered(path_, on);
    return on;
  }

  /// Hands over the frames that have collided: together if they have flown alike.
  template <class Tracer>
  void collide(const MediumFlight& flight, Tracer& tracer) {
    const float distance = path_.passed + flight.distance();
    if constexpr (requires { tracer.glowed(path_, path_.frames, Spectrum()); })
      for (const FrameFactor& glow : flight.glowing())
        branches_.dim(path_, path_.inside, glow.frames, distance, tracer,
                      [&](const Path& left) { tracer.glowed(left, left.frames, glow.factor); });
    FrameSet done;
    for (const auto& first : flight.colliding()) {
      if (!(first.flown.frames & done).empty()) continue;
      MediumVertex vertex{.point = path_.ray.at(flight.distance()),
                          .wo = -path_.ray.direction,
                          .distance = distance,
                          .medium = path_.inside.medium,
                          .states = {},
                          .majorant = flight.majorant()};
      for (const auto& each : flight.colliding())
        if (each.flown.weight == first.flown.weight && each.flown.share == first.flown.share)
          vertex.states.add({each.flown.frames, each.albedo, HenyeyGreenstein(each.g)});
      const FrameSet together = vertex.frames();
      done |= together;
      branches_.parted_ |= together != path_.frames || vertex.states.size() > 1;
      branches_.dim(flown(first.flown, together, flight.numbers(), tracer), path_.inside, together, distance, tracer,
                    [&](const Path& left) { tracer.collided(left, vertex); });
    }
  }

  /// What is left of a path that has passed through a medium to one of its meetings.
  struct Passed {
    std::size_t meeting;
    FrameSet frames;
    Spectrum left;
    int numbers;
  };

  /// Passes through the medium: in each of its states section by section, up to what the frames meet one after another.
  /// Frames that meet the same then go on as one path, if the tracer has strands.
  template <class Tracer>
  void pass(Tracer& tracer) {
    FrameArray<Passed> passed;
    medium().majorants.for_each(path_.frames, [&](FrameSet alike, const Majorants& majorants) {
      medium().states.for_each(alike, [&](FrameSet frames, const Medium& state) {
        steps_.clear();
        SegmentNumbers numbers{path_.random, path_.bounces, path_.flights.numbers};
        MediumPassage passage(state, majorants, *scene_.palette, path_.ray, numbers, steps_);
        Path within = path_;
        within.frames = frames;
        for (std::size_t m = 0; m < meetings_.size(); ++m) {
          const FrameSet landing = within.frames & meetings_[m].frames;
          if (landing.empty()) continue;
          DrawnCollision drawn(state.everywhere() ? 0 : numbers.next());
          tracer.beamed(within, passage.advance(meetings_[m].hit.t, &drawn));
          if (!is_black(passage.left())) passed.add({m, landing, passage.left(), numbers.used});
          within.frames = within.frames - landing;
        }
      });
    });
    FrameSet done;
    for (const Passed& first : passed) {
      if (!(first.frames & done).empty()) continue;
      FrameArray<FrameFactor> left;
      for (const Passed& each : passed)
        if (each.meeting == first.meeting && each.numbers == first.numbers && (each.frames & done).empty())
          left.add({each.frames, each.left});
      for (const FrameFactor& each : left) done |= each.frames;
      Path on = path_;
      on.flights.numbers = first.numbers;
      land_dimmed(on, left, meetings_[first.meeting], tracer);
    }
  }

  template <class Tracer>
  void land_dimmed(const Path& path, const FrameArray<FrameFactor>& left, const Meeting& meeting, Tracer& tracer) {
    if constexpr (requires { tracer.strands(); }) {
      Path on = path;
      on.frames &= meeting.frames;
      if (multiply(on, left, tracer.strands(), ByRatio::yes, keep_all)) land(on, meeting, tracer);
    } else {
      for (const FrameFactor& each : left) {
        Path on = path;
        on.frames = each.frames, on.throughput *= each.factor;
        land(on, meeting, tracer);
      }
    }
  }

  /// Hands the path to the tracer at a surface, or sends it on through a boundary.
  template <class Tracer>
  void land(const Path& path, const Meeting& meeting, Tracer& tracer) {
    if (meeting.is_boundary) {
      const BoundaryPoint point(*scene_.boundaries, meeting.hit, path.ray.direction);
      Path& on = branches_.push(path);
      on.ray = point.beyond(path.ray, meeting.hit.t), on.inside.medium = point.medium_beyond(path.ray.direction);
      on.passed += meeting.hit.t;
      return;
    }
    HitPartition part;
    part.add(path.frames, meeting.hit);
    if (!tracer.postpones(path, part)) branches_.arrive(path, part[0], tracer);
  }

  Branches& branches_;
  const Scene& scene_;
  const Path path_;
  const FrameArray<Meeting> meetings_;
  std::vector<MediumStep>& steps_;
};

}  // namespace dspm
