// The scattering of surfaces that a GPU shares with the CPU: each Bsdf is made of plain values in memory, and asked for
// all that integrators ask for.
#include "words.h"

#include <concepts>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/conductor_bsdf.h"
#include "dspm/materials/dielectric_bsdf.h"
#include "dspm/materials/diffuse_bsdf.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/materials/thin_dielectric_bsdf.h"

namespace dspm {

struct Input {
  Vec3 ns, ng, tangent;
  Vec2 alpha;
  float eta;
  Spectrum colour, metal_eta, metal_k;
  Refraction refraction;
  GlassTables glass;
  MetalTables metal;
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
  const Vec3 wi = sample ? sample->wi : in.ns;
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

extern "C" __global__ void bsdfs(const dspm::Input* input, dspm::Output* outputs) {
  using namespace dspm;
  const Input& in = *input;
  const ShadingFrame frame(in.ns, in.ng, in.tangent);
  const Ggx facets(in.alpha);
  outputs[0] = asked(Diffuse(in.ng, in.ns, in.colour), in);
  outputs[1] = asked(SmoothDielectric(frame, in.refraction), in);
  outputs[2] = asked(RoughDielectric(frame, facets, in.refraction, in.glass), in);
  outputs[3] = asked(SmoothConductor(frame, in.metal_eta, in.metal_k), in);
  outputs[4] = asked(RoughConductor(frame, facets, in.metal_eta, in.metal_k, in.metal), in);
  outputs[5] = asked(ThinDielectric(frame, in.eta, in.colour), in);
}
