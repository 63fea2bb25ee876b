#include "dspm/integrators/photons/beam_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/photons/near_light.h"
#include "dspm/integrators/transport/balance.h"
#include "dspm/integrators/transport/body.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/medium_vertex.h"

namespace dspm {
namespace {

/// A point of a beam; `scattered` is sigma_s there, times what is left at the ray's origin, over the density of the draw.
struct DrawnPoint {
  float t = 0;
  Spectrum scattered;
  float g = 0;
};

/// The part of a section in which there may be anything of the medium.
class Segment {
 public:
  Segment(const Ray& ray, const MediumSection& section, const Palette& palette)
      : ray_(ray), section_(section), palette_(palette), begin_(section.begin), end_(section.end) {
    if (const auto extent = section.medium->extent()) clip(*extent);
    if (const auto same = section.medium->everywhere()) everywhere_ = section.medium->carried(*same, palette);
    if (!everywhere_) return;
    for (int c = 0; c < 3; ++c)
      if (everywhere_->sigma_s[c] > 0) colours_[count_++] = {everywhere_->sigma_t()[c], length()};
  }

  bool is_empty() const { return !(end_ > begin_) || (everywhere_ && count_ == 0); }
  float begin() const { return begin_; }
  float end() const { return end_; }
  float length() const { return end_ - begin_; }

  /// Draws a point where the medium scatters most.
  std::optional<DrawnPoint> draw(Vec2 u) const {
    if (!everywhere_) {
      const DrawnCollision& drawn = section_.drawn;
      if (!drawn.has_any()) return std::nullopt;
      return DrawnPoint{drawn.t(), drawn.scattered(), drawn.g()};
    }
    const int colour = std::min(count_ - 1, static_cast<int>(u.y * static_cast<float>(count_)));
    const float t = std::min(end_, begin_ + colours_[colour].draw(u.x));
    return at(t, density(t));
  }
  /// Returns how densely draw() draws points. If the medium varies this is a guess that does not ask what it is like: good
  /// enough for weights.
  float density(float t) const {
    if (!everywhere_) return 1 / length();
    float sum = 0;
    for (int i = 0; i < count_; ++i) sum += colours_[i].density(t - begin_);
    return sum / static_cast<float>(count_);
  }
  /// Returns a point that was drawn with that density.
  DrawnPoint at(float t, float density) const {
    const CarriedMedium here =
        everywhere_ ? *everywhere_ : section_.medium->carried(section_.medium->at(ray_.at(t)), palette_);
    return {t, here.sigma_s * section_.left_at(t) / density, here.g};
  }

 private:
  /// Distances by the law that collisions of one colour follow, up to a length.
  struct Exponential {
    float sigma = 0, within = 0;  // the chance to collide within the length

    Exponential() = default;
    Exponential(float sigma_t, float length)
        : sigma(sigma_t), within(static_cast<float>(-std::expm1(-double{sigma_t} * double{length}))) {}
    float draw(float u) const { return -rounded::log1p(-u * within) / sigma; }
    float density(float distance) const { return sigma * rounded::exp(-sigma * distance) / within; }
  };

  void clip(const Bounds3& box) {
    for (int axis = 0; axis < 3; ++axis) {
      const float o = ray_.origin[axis], d = ray_.direction[axis];
      if (d == 0) {
        if (o < box.low[axis] || o > box.high[axis]) end_ = begin_;
        continue;
      }
      begin_ = std::max(begin_, ((d > 0 ? box.low : box.high)[axis] - o) / d);
      end_ = std::min(end_, ((d > 0 ? box.high : box.low)[axis] - o) / d);
    }
  }

  const Ray& ray_;
  const MediumSection& section_;
  const Palette& palette_;
  std::optional<CarriedMedium> everywhere_;
  float begin_, end_;
  Exponential colours_[3];  // those that are scattered, if the medium is the same everywhere
  int count_ = 0;
};

/// Finds the light that one section of a path's segment scatters.
class LitSection {
 public:
  LitSection(const Scene& scene, const CameraPath& path, const MediumSection& section, HitPointWriter& out)
      : scene_(scene), path_(path), bounce_(path.bounces + 1), segment_(path.ray, section, *scene.palette), out_(out) {}

  bool is_empty() const { return segment_.is_empty(); }

  void add_where_it_scatters() {
    const auto drawn = segment_.draw(path_.random.pair(bounce_, kScatteringPoint));
    if (!drawn || is_black(drawn->scattered)) return;
    const MediumVertex vertex{path_.ray.at(drawn->t), -path_.ray.direction, drawn->t, path_.inside.medium, {}};
    sample_direct_light(
        scene_, path_, vertex, path_.frames, out_.paths(),
        [&](const LightSample& sample) {
          const float here = samples_where_it_scatters(sample.scene_light, vertex.point, drawn->t);
          const auto near = near_light(sample.light);
          const float there = near ? samples_near(sample.scene_light) * near->density(drawn->t) : 0;
          return scattered(*drawn, sample.lit.wi) * balance(here, there);
        },
        [&](FrameSet frames, const Spectrum& radiance, auto&& giver) { out_.see(path_, frames, radiance, giver); });
  }

  /// Near each of a few lights, or one of many.
  void add_near_lights() {
    const Vec2 u = path_.random.pair(bounce_, kNearLight);
    FrameArray<ChosenSample> choosing;
    FrameArray<Vec3> points;  // of the samples, by number
    choosing.add({path_.frames, u.y});
    if (scene_.lights.size() <= LightSamples::kFewLights) {
      for (const SceneLight& light : scene_.lights) offer(light, path_.frames, 1, u.x, choosing, points);
    } else {
      for (const LightChoice& choice : scene_.light_choices) {
        const FrameSet frames = path_.frames & choice.frames;
        if (frames.empty()) continue;
        const ChosenLight chosen = choice.choose(u.y);
        offer(scene_.lights[static_cast<std::size_t>(chosen.index)], frames, chosen.probability, u.x, choosing, points);
      }
    }
    see_chosen(
        scene_, choosing,
        [&](const ChosenSample& chosen, FrameSet frames, auto&& see) {
          for_each_lit(points[static_cast<std::size_t>(chosen.number)], chosen.lit, frames, see);
        },
        [&](FrameSet frames, const Spectrum& radiance, auto&& giver) { out_.see(path_, frames, radiance, giver); });
  }

 private:
  static constexpr int kNumbersNearLights = 1 << 12;  // apart from those of the other shadow ray

  std::optional<NearLight> near_light(const Light& light) const {
    const auto bounds = light.bounds();
    if (!bounds) return std::nullopt;
    const NearLight near(path_.ray, segment_.begin(), segment_.end(), *bounds);
    return near.is_empty() ? std::nullopt : std::optional(near);
  }

  Spectrum scattered(const DrawnPoint& point, const Vec3& wi) const {
    return point.scattered * HenyeyGreenstein(point.g).pdf_w(path_.ray.direction, wi);
  }

  // Mean numbers of samples of a light. As light_samples(), they are the mean over the frames of the file that have it.
  float samples_where_it_scatters(const SceneLight& light, const Vec3& p, float t) const {
    return light_samples(scene_, light, {p, {}}) * segment_.density(t);
  }
  float samples_near(const SceneLight& light) const {
    if (scene_.lights.size() <= LightSamples::kFewLights) return 1;
    const auto index = static_cast<std::size_t>(&light - scene_.lights.data());
    if (scene_.light_choices.size() == 1) return scene_.light_choices.front().probability()[index];
    float sum = 0;
    for (std::size_t c = 0; c < scene_.light_choices.size(); ++c)
      sum += light.choice_shares[c] * scene_.light_choices[c].probability()[index];
    return sum;
  }

  template <class See>
  void for_each_lit(const Vec3& p, const Illumination& lit, FrameSet frames, See&& see) {
    ++out_.paths().shadow_rays;
    for_each_open(scene_, {p, lit.wi, lit.distance * kShortOfLight}, path_.inside, frames,
                  {path_.random, bounce_, kNumbersNearLights}, see);
  }

  /// Offers a sample at a point near the light, of which there are so many on average.
  void offer(const SceneLight& scene_light, FrameSet frames, float samples, float u, FrameArray<ChosenSample>& choosing,
             FrameArray<Vec3>& points) {
    scene_light.states.for_each(frames, [&](FrameSet common, const Light& light) {
      const auto near = near_light(light);
      if (!near || !(samples > 0)) return;
      const float t = near->draw(u), density = near->density(t);
      const Vec3 p = path_.ray.at(t);
      const auto lit = light.illuminate(p, path_.random.pair(bounce_, kLightPoint));
      if (!lit || !(density > 0)) return;
      const float here = samples_near(scene_light) * density, there = samples_where_it_scatters(scene_light, p, t);
      const Spectrum radiance = scattered(segment_.at(t, samples * density), lit->wi) *
                                light.carried(lit->radiance, *scene_.palette) *
                                (balance(here, there) / (lit->pdf_w > 0 ? lit->pdf_w : 1));
      const auto giver = [&] { return light_element(scene_, scene_light); };
      if (!is_light(radiance)) return out_.see(path_, common, radiance, giver);
      if (!(max_component(radiance) > 0)) return;
      if (is_told_by_a_ray(scene_, scene_light))
        return for_each_lit(p, *lit, common, [&](FrameSet open, const Spectrum& transmittance) {
          out_.see(path_, open, radiance * transmittance, giver);
        });
      const auto number = static_cast<int>(points.size());
      points.add(p);
      offer_to(common, choosing, [&](ChosenSample& chosen) { chosen.offer(number, scene_light, *lit, radiance); });
    });
  }

  const Scene& scene_;
  const CameraPath& path_;
  const int bounce_;
  const Segment segment_;
  HitPointWriter& out_;
};

}  // namespace

void BeamLight::add(const CameraPath& path, const MediumSection& section) {
  LitSection here(scene_, path, section, out_);
  if (here.is_empty()) return;
  here.add_where_it_scatters();
  here.add_near_lights();
}

}  // namespace dspm
