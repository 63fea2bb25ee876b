// The bodies of a scene as plain values: what nesting.h and body.h know of them, if all frames agree in it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/integrators/transport/overlap.h"
#include "dspm/media/beers_law.h"
#include "dspm/world/scene/inside.h"

namespace dspm {

/// A material as the body that it bounds, if it does.
struct PlainBody {
  bool is_one = false;
  int rank = 0;          // Material::priority()
  Spectrum absorption;   // as paths carry it
  int surroundings = 0;  // what it is for bodies that lie in it, see PlainScene

  constexpr int priority() const { return rank; }
};

struct PlainBodies {
  const PlainBody* of_material = nullptr;  // null: no path needs to know the bodies around it
  std::size_t count = 0;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(of_material, count);
  }

  /// Returns the share of light that is left after a distance, perhaps infinite, in these bodies.
  constexpr Spectrum left_within(const Inside& inside, float distance) const {
    const States states(*this, inside.bodies());
    const PlainBody* top = top_of(states.all());
    return top == nullptr ? Spectrum(1) : left_after(top->absorption, distance);
  }

  /// See met_surface(). `body` may be kNoBody.
  constexpr MetSurface<PlainBody> met(const Inside& inside, int body, bool from_within, bool emits) const {
    Inside others = inside;
    others.leave(body);
    if (body != kNoBody && !others.is_empty()) {
      const States states(*this, others.bodies());
      return met_surface(body, of_material[body], from_within, emits, inside, others.bodies(), states.all());
    }
    MetSurface<PlainBody> met{.arriving = inside};
    if (from_within) met.arriving.enter(body);
    return met;
  }

  /// Returns MetSurface::around of a surface that is there.
  constexpr const PlainBody* around(int body, const Inside& arriving) const {
    if (body == kNoBody) return nullptr;
    Inside others = arriving;
    others.leave(body);
    const States states(*this, others.bodies());
    return body_around(of_material[body], states.all());
  }

 private:
  class States {
   public:
    constexpr States(const PlainBodies& bodies, std::span<const int> list) : count_(list.size()) {
      for (std::size_t i = 0; i < count_; ++i)
        states_[i] = bodies.of_material[list[i]].is_one ? &bodies.of_material[list[i]] : nullptr;
    }
    constexpr std::span<const PlainBody* const> all() const { return {states_.data(), count_}; }

   private:
    std::array<const PlainBody*, Inside::kMost> states_{};
    std::size_t count_;
  };
};

}  // namespace dspm
