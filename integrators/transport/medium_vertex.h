// A path's collision with a medium.
#pragma once

#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/media/henyey_greenstein.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// What a path remembers of its flights through media.
struct Flights {
  Spectrum share{1};  // of the density of the path's points by each colour's flights, over the mean of all three
  int numbers = 0;    // random ones, drawn for the next segment so far
};

/// What gives off a medium's own light: the light that it is or, if that lights nothing, the medium.
inline SceneElement glow_element(const Scene& scene, int medium) {
  const int light = scene.media[static_cast<std::size_t>(medium)].light;
  return light < 0 ? SceneElement{SceneElement::Kind::medium, medium} : SceneElement{SceneElement::Kind::light, light};
}

/// A collision, in the frames that meet the medium at the same point. It is a place that is lit, as a Vertex is.
struct MediumVertex {
  /// How the medium scatters light there in some of the frames.
  struct State {
    FrameSet frames;
    Spectrum albedo;
    HenyeyGreenstein phase;
  };

  Vec3 point;
  Vec3 wo;         // back along the path, unit length
  float distance;  // of the path's segment
  int medium;      // into Scene::media
  FrameArray<State> states;
  Spectrum majorant = {};  // the same in all of these frames

  FrameSet frames() const {
    FrameSet all;
    for (const State& state : states) all |= state.frames;
    return all;
  }

  const Vec3& p() const { return point; }
  LightReceiver receiver() const { return {point, Vec3{}}; }
  float cosine(const Vec3&) const { return 1; }
  Ray spawn(const Vec3& w) const { return {point, w}; }
  Inside inside_beyond(const Inside& arriving, const Vec3&) const { return arriving; }
  SceneElement scatterer() const { return {SceneElement::Kind::medium, medium}; }
};

/// Calls fn(const HenyeyGreenstein&, std::span<const FrameFactor> albedos) for frames that are scattered alike but for colour;
/// without `join`, for each state.
template <class Fn>
void for_each_phase(const MediumVertex& vertex, bool join, Fn&& fn) {
  FrameSet done;
  for (const MediumVertex::State& first : vertex.states) {
    if (!(first.frames & done).empty()) continue;
    FrameArray<FrameFactor> albedos;
    for (const MediumVertex::State& state : vertex.states)
      if (&state == &first || (join && state.phase == first.phase && (state.frames & done).empty()))
        albedos.add({state.frames, state.albedo});
    for (const FrameFactor& albedo : albedos) done |= albedo.frames;
    fn(first.phase, std::span<const FrameFactor>(albedos));
  }
}

}  // namespace dspm
