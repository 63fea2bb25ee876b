// Where paths start, on a GPU as on the CPU: light that lamps emit and give to a point, and the rays of cameras.
#include "words.h"

#include <cstdint>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/orthographic_rays.h"
#include "dspm/cameras/perspective_rays.h"
#include "dspm/lights/diffuse_emission.h"
#include "dspm/lights/distant_emitter.h"
#include "dspm/lights/emission.h"
#include "dspm/lights/point_emitter.h"
#include "dspm/lights/spot_emitter.h"

namespace dspm {

/// What a light, or a lamp's surface, says of the start of a path and of the way back to its numbers.
struct Emitted {
  Emission emission;
  EmissionPdf pdf;
  EmissionNumbers numbers;
};

template <class Emitter>
constexpr Emitted emitted(const Emitter& emitter, Vec2 u_position, Vec2 u_direction) {
  const Emission e = emitter.emit(u_position, u_direction);
  return {e, emitter.pdf_emit(e.ray), emitter.emission_numbers(e.ray)};
}

template <class Emitter>
constexpr Illumination illumination(const Emitter& emitter, const Vec3& p) {
  return emitter.illuminate(p).value_or(Illumination{{}, kInfinity, emitter.power(), 0});
}

constexpr Emitted emitted(const DiffuseEmission& directions, const Ray& around, Vec2 u) {
  const Vec3 w = directions.sample(around.direction, u);
  const Vec2 numbers = directions.numbers(around.direction, w);
  const float cosine = dot(around.direction, w);
  const EmissionPdf pdf{1, directions.pdf_w(cosine), true, false};
  return {{{around.origin, w}, Rgb(directions.shines(cosine) ? directions.sides() : 0), pdf},
          pdf,
          {u.x, u.y, numbers.x, numbers.y}};
}

/// The start of a camera path, and what the camera says of a point on its way.
struct Started {
  Ray ray;
  float spacing;
  Sighting back;
};

template <class Rays>
constexpr Started started(const Rays& rays, Vec2 film, Vec2 lens) {
  const Ray ray = rays.ray(film, lens);
  return {ray, rays.pixel_spacing(1), rays.sight(ray.at(1), lens).value_or(Sighting{{}, {}, kInfinity, 0})};
}

struct Lamps {
  PointEmitter point;
  SpotEmitter spot;
  DistantEmitter distant;
  DiffuseEmission surface;
  Ray around;  // a point of the surface, and its normal
};
struct Cameras {
  PerspectiveRays perspective;
  OrthographicRays orthographic;
};
struct Starts {
  Emitted emitted[4];
  Illumination light[3];
  Started cameras[2];
};

}  // namespace dspm

extern "C" __global__ void starts(const dspm::Lamps* lamps, const dspm::Cameras* cameras, std::uint64_t seed,
                                  dspm::Starts* output) {
  using namespace dspm;
  const PathRandom random = PathRandom::even(seed, Stream::photon, seed, 3);
  const Vec2 position = random.pair(0, 0), direction = random.pair(0, 1);
  output->emitted[0] = emitted(lamps->point, position, direction);
  output->emitted[1] = emitted(lamps->spot, position, direction);
  output->emitted[2] = emitted(lamps->distant, position, direction);
  output->emitted[3] = emitted(lamps->surface, lamps->around, direction);
  const Vec3 lit = lamps->around.origin;
  output->light[0] = illumination(lamps->point, lit);
  output->light[1] = illumination(lamps->spot, lit);
  output->light[2] = illumination(lamps->distant, lit);
  output->cameras[0] = started(cameras->perspective, position, direction);
  output->cameras[1] = started(cameras->orthographic, position, direction);
}
