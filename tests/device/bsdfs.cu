// The scattering of surfaces that a GPU shares with the CPU: materials are plain values in memory, and the Bsdf of each at a
// point is asked for all that integrators ask for.
#include "words.h"

#include <concepts>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_material.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

struct Input {
  SurfaceGeometry point;
  HuedWavelength wavelength;
  PlainMaterial material;
  Vec3 wo, u;
  Transport transport;
  LobeSet lobes;
};
struct Output {
  BsdfSample sample;
  Spectrum f;
  float pdf_w, probability;
  LobeSet all_lobes;
  bool transmits, disperses;
  Spectrum everywhere;
};

template <std::derived_from<PlainBsdf> T>
constexpr Output asked(const T& bsdf, const Input& in) {
  const LobeSet all = bsdf.lobes(0), lobes = in.lobes & all;
  const auto sample = bsdf.sample(in.wo, in.u, in.transport, lobes);
  const Vec3 wi = sample ? sample->wi : in.point.ns;
  return {sample.value_or(BsdfSample{}),
          bsdf.evaluate(in.wo, wi, in.transport, lobes),
          bsdf.pdf_w(in.wo, wi, in.transport, lobes),
          bsdf.lobe_probability(in.wo, lobes),
          all,
          bsdf.transmits(lobes),
          bsdf.disperses(in.wo, wi),
          bsdf.lambertian(lobes).value_or(Spectrum(0))};
}

}  // namespace dspm

extern "C" __global__ void bsdfs(const dspm::Input* input, dspm::Output* output) {
  using namespace dspm;
  const Input& in = *input;
  *output = in.material.with_bsdf(in.point, in.wavelength, [&](const auto& bsdf) { return asked(bsdf, in); });
}
