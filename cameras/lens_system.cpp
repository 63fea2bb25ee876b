#include "dspm/cameras/lens_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace dspm {
namespace {

/// The place where a ray meets a spherical surface whose vertex is at z, and the normal there against the ray.
struct Met {
  Vec3 p, n;
};

// As seen from the vertex, and without differences of squares: radii may be much larger than the lens.
std::optional<Met> meet(const Ray& ray, float z, float radius) {
  const Vec3 o = ray.origin - Vec3{0, 0, z};
  const float b = dot(o, ray.direction) + radius * ray.direction.z, c = length2(o) + 2 * radius * o.z;
  const float discriminant = b * b - c;
  if (!(discriminant >= 0)) return std::nullopt;
  // The surface is the half of the sphere around its vertex: the far one for a ray that leaves through a bulge.
  const float root = std::sqrt(discriminant), far = (ray.direction.z > 0) == (radius > 0) ? 1.f : -1.f;
  const float t = b * far > 0 ? c / (-b - far * root) : far * root - b;
  if (!(t >= 0)) return std::nullopt;
  const Vec3 p = ray.at(t), n = normalize(p + Vec3{0, 0, radius - z});
  return Met{p, dot(n, ray.direction) > 0 ? -n : n};
}

/// Refracts w by Snell's law; nullopt if it is reflected totally.
std::optional<Vec3> refracted(const Vec3& w, const Vec3& n, float from, float to) {
  const float eta = from / to, cosine = -dot(w, n), sine2 = eta * eta * (1 - cosine * cosine);
  if (!(sine2 < 1)) return std::nullopt;
  return normalize(w * eta + n * (eta * cosine - std::sqrt(1 - sine2)));
}

float index_of(float eta) { return eta > 0 ? eta : 1; }

bool is_within(const Vec3& p, float aperture) { return p.x * p.x + p.y * p.y <= aperture * aperture; }

/// Moves the ray onto a stop; returns false if it points away from it.
bool reach_stop(Ray& ray, float z) {
  const float t = (z - ray.origin.z) / ray.direction.z;
  if (!(t >= 0)) return false;
  ray.origin = ray.at(t);
  return true;
}

/// Moves the ray onto a surface and bends it there; returns false if it does not pass.
bool pass(Ray& ray, const LensSurface& surface, float z, float from, float to) {
  const auto met = meet(ray, z, surface.curvature);
  if (!met || !is_within(met->p, surface.aperture)) return false;
  const auto w = refracted(ray.direction, met->n, from, to);
  if (w) ray = {met->p, *w};
  return w.has_value();
}

/// The cardinal points on one side: where a ray along the axis on the other side crosses it here, and where it seems to
/// have been bent.
struct Cardinal {
  float focus, principal;
};

Cardinal cardinal(const Ray& in, const Ray& out) {
  return {out.at(-out.origin.x / out.direction.x).z, out.at((in.origin.x - out.origin.x) / out.direction.x).z};
}

}  // namespace

LensSystem::LensSystem(std::vector<LensSurface> surfaces, Diaphragm diaphragm)
    : surfaces_(std::move(surfaces)), z_(surfaces_.size()), diaphragm_(std::move(diaphragm)) {
  set_film_distance(surfaces_.back().thickness);
}

void LensSystem::set_film_distance(float distance) {
  surfaces_.back().thickness = distance;
  float z = 0;
  for (std::size_t i = surfaces_.size(); i-- > 0;) z_[i] = z += surfaces_[i].thickness;
}

LensSystem LensSystem::with_round_stop() const {
  std::vector<LensSurface> surfaces = surfaces_;
  for (LensSurface& surface : surfaces)
    if (surface.curvature == 0) surface.aperture *= diaphragm_.reach();
  return LensSystem(std::move(surfaces));
}

std::optional<LensSystem::Passage> LensSystem::from_film(const Ray& start) const {
  Passage passage{{start.origin, normalize(start.direction)}};
  for (std::size_t i = surfaces_.size(); i-- > 0;) {
    const LensSurface& surface = surfaces_[i];
    if (surface.curvature != 0) {
      const float before = i > 0 ? index_of(surfaces_[i - 1].eta) : 1;
      if (!pass(passage.ray, surface, z_[i], index_of(surface.eta), before)) return std::nullopt;
    } else {
      if (!reach_stop(passage.ray, z_[i])) return std::nullopt;
      const Vec3& p = passage.ray.origin;
      passage.share *= diaphragm_.share({p.x / surface.aperture, p.y / surface.aperture});
      if (!(passage.share > 0)) return std::nullopt;
    }
  }
  return passage;
}

std::optional<Ray> LensSystem::from_scene(const Ray& start) const {
  Ray ray{start.origin, normalize(start.direction)};
  float before = 1;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const LensSurface& surface = surfaces_[i];
    const bool passes = surface.curvature != 0 ? pass(ray, surface, z_[i], before, index_of(surface.eta))
                                               : reach_stop(ray, z_[i]) && is_within(ray.origin, surface.aperture);
    if (!passes) return std::nullopt;
    before = index_of(surface.eta);
  }
  return ray;
}

// [Kolb, Mitchell, Hanrahan 1995, A Realistic Camera Model for Computer Graphics, 3.2; Pharr, Jakob, Humphreys,
// Physically Based Rendering, 3rd ed., 6.4.3]
std::optional<LensSystem::ThickLens> LensSystem::thick_lens() const {
  float height = kInfinity;
  for (const LensSurface& surface : surfaces_) height = std::min(height, surface.aperture);
  height = std::min(height / 2, 3.5e-5f);  // pbrt's, for film of 35 mm
  constexpr float kBefore = 0.01f;
  const Ray in_scene{{height, 0, front_z() + kBefore}, {0, 0, -1}}, at_film{{height, 0, rear_z() - kBefore}, {0, 0, 1}};
  const auto to_film = from_scene(in_scene);
  const auto to_scene = with_round_stop().from_film(at_film);  // a shape may be dark in its middle
  if (!to_film || !to_scene) return std::nullopt;
  const Cardinal film = cardinal(in_scene, *to_film), scene = cardinal(at_film, to_scene->ray);
  const ThickLens lens{film.principal - film.focus, scene.principal, film.principal};
  if (!std::isfinite(lens.focal_length) || !std::isfinite(lens.scene_principal)) return std::nullopt;
  return lens;
}

// The principal planes are a and b before the object and behind them the film: a + b is known, and 1/a + 1/b = 1/f.
float LensSystem::focus(float distance) {
  const auto lens = thick_lens();
  if (!lens) throw std::runtime_error("no light comes to a focus: rays along its axis are stopped, or are not bent");
  if (!(lens->focal_length > 0)) throw std::runtime_error("it scatters light, so it cannot make an image");
  const float both = distance - lens->scene_principal + lens->film_principal;
  if (!(both > 4 * lens->focal_length))
    throw std::runtime_error(fmt::format("what is closer than {:.3g} m before the film cannot be sharp",
                                         distance + 4 * lens->focal_length - both));
  const float to_film = (both - std::sqrt(both * (both - 4 * lens->focal_length))) / 2;
  const float thickness = surfaces_.back().thickness + to_film - lens->film_principal;
  if (!(thickness > 0)) throw std::runtime_error("to be sharp, the film would have to be within the lens");
  set_film_distance(thickness);
  return to_film;
}

}  // namespace dspm
