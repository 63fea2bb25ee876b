#include "dspm/testing/scattering.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/testing/chi2.h"
#include "dspm/testing/scattering_cases.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace {

constexpr Transport kTransports[] = {Transport::radiance, Transport::flux};

std::string text(const Vec3& v) { return fmt::format("({} {} {})", v.x, v.y, v.z); }
std::string text(const Spectrum& c) { return fmt::format("({} {} {})", c[0], c[1], c[2]); }
const char* text(Transport transport) { return transport == Transport::radiance ? "radiance" : "flux"; }

bool near(const Spectrum& a, const Spectrum& b, float relative) {
  for (int c = 0; c < 3; ++c)
    if (!(std::abs(a[c] - b[c]) <= relative * std::max(std::abs(a[c]), std::abs(b[c])) + 5e-6f)) return false;
  return true;
}

/// Calls fn(bsdf, point) on each surface.
template <class Fn>
void on_surfaces(const Material& material, const Fn& fn) {
  for (const SurfacePoint& point : {surface(), bent_surface()}) {
    BsdfSlot slot;
    fn(material.bsdf(point, slot), point);
  }
}

struct DensityCase {
  SurfacePoint point;
  Vec3 wo;
  LobeSet lobes;
  Transport transport;
};

/// Returns where the density is highest among some samples: there cells should be finest.
Vec3 peak(const Bsdf& bsdf, const DensityCase& c, const PathRandom& random) {
  Vec3 best = c.wo;
  float highest = 0;
  for (int n = 0; n < 64; ++n) {
    const auto drawn = bsdf.sample(c.wo, three_numbers(random, n), c.transport, c.lobes);
    if (drawn && drawn->pdf_w > highest) highest = drawn->pdf_w, best = drawn->wi;
  }
  return best;
}

/// One lobe, all, and what integrators ask for: the lobes that gather, and those that do not.
std::vector<LobeSet> telling_subsets_of(const Bsdf& bsdf) {
  const LobeSet all = bsdf.all_lobes();
  std::vector<LobeSet> asked{all};
  for (const float least_alpha : {0.05f, 0.1f, 0.25f, 0.5f, 0.9f})
    asked.push_back(bsdf.lobes(least_alpha)), asked.push_back(static_cast<LobeSet>(all & ~asked.back()));
  std::vector<LobeSet> subsets = subsets_of(all);
  std::erase_if(subsets, [&](LobeSet set) {
    return !std::has_single_bit(static_cast<unsigned>(set)) &&
           std::find(asked.begin(), asked.end(), set) == asked.end();
  });
  return subsets;
}

std::vector<DensityCase> density_cases(const Material& material) {
  std::vector<DensityCase> cases;
  on_surfaces(material, [&](const Bsdf& bsdf, const SurfacePoint& point) {
    if (bsdf.lobes(1e-6f) == 0) return;  // fully specular: no density
    for (const Vec3& wo : directions())
      for (const LobeSet lobes : telling_subsets_of(bsdf)) {
        // Where ns turns away from the camera, ng's horizon cuts through the middle of sharp lobes, which cells do not
        // see; weights_agree covers it.
        if (dot(wo, point.ng) * dot(wo, point.ns) > 0) cases.push_back({point, wo, lobes, Transport::radiance});
        if (!(point.ns == point.ng)) cases.push_back({point, wo, lobes, Transport::flux});
      }
  });
  return cases;
}

Chi2Result chi2_of(const Material& material, const DensityCase& c, Chi2Settings settings, std::uint64_t seed) {
  BsdfSlot slot;
  const Bsdf& bsdf = material.bsdf(c.point, slot);
  const PathRandom random(seed, Stream::setup, 0, 0);
  settings.axis = peak(bsdf, c, PathRandom(seed, Stream::setup, 1, 0));
  int n = 0;
  const auto sample = [&]() -> std::optional<Vec3> {
    const auto drawn = bsdf.sample(c.wo, three_numbers(random, n++), c.transport, c.lobes);
    if (!drawn || drawn->specular || !is_finite(drawn->wi)) return std::nullopt;  // weights_agree reports the last
    return drawn->wi;
  };
  return SphereChi2(settings).run(sample, [&](const Vec3& wi) { return bsdf.pdf_w(c.wo, wi, c.transport, c.lobes); });
}

/// Returns the fault of one sample; empty if there is none.
std::string fault(const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo, Transport transport, LobeSet lobes,
                  const BsdfSample& drawn) {
  if (!(std::abs(length(drawn.wi) - 1) < 1e-5f)) return "is not of unit length";
  if (drawn.specular) return drawn.pdf_w == 0 ? "" : "is specular and has a density";
  if (!(drawn.pdf_w > 0)) return "has no density";
  // Facet normals recomputed from both directions differ in the last digits, which sharp lobes magnify.
  const float pdf_w = bsdf.pdf_w(wo, drawn.wi, transport, lobes);
  if (!(std::abs(pdf_w - drawn.pdf_w) <= 3e-3f * drawn.pdf_w))
    return fmt::format("says density {}, pdf_w says {}", drawn.pdf_w, pdf_w);
  const Spectrum weight =
      bsdf.evaluate(wo, drawn.wi, transport, lobes) * (std::abs(dot(drawn.wi, point.ns)) / drawn.pdf_w);
  if (!near(drawn.weight, weight, 3e-3f))
    return "says weight " + text(drawn.weight) + ", evaluate says " + text(weight);
  return "";
}

}  // namespace

std::shared_ptr<const Material> material_of(const std::string& words) {
  const TestScene scene("WorldBegin\nMaterial " + words + "\nShape \"disk\"");
  const auto made = scene.scene({FileFrame(0)});
  return made->materials[static_cast<std::size_t>(made->shapes[0].material)].states[0].object;
}

Verdict samples_follow_density(const Material& material, double level, std::uint64_t seed, int samples) {
  const std::vector<DensityCase> cases = density_cases(material);
  Chi2Settings settings;
  settings.samples = samples;
  settings.level = level;
  settings.tests = static_cast<int>(cases.size());
  Verdict verdict;
  double least = 1;
  for (const DensityCase& c : cases) {
    const Chi2Result result = chi2_of(material, c, settings, seed++);
    least = std::min(least, result.p_value);
    if (!result.passed || !(result.integral < 1 + 2e-3))
      verdict.fail(fmt::format(
          "wo {}, lobes {}: p = {:.2g} at chi2 = {:.1f} with {} degrees of freedom; the density's "
          "integral is {:.4f}\n{}",
          text(c.wo), c.lobes, result.p_value, result.statistic, result.dof, result.integral, result.worst));
  }
  if (verdict.passed) verdict.message = fmt::format("{} tests, the least p = {:.2g}", cases.size(), least);
  return verdict;
}

Verdict weights_agree(const Material& material) {
  Verdict verdict;
  const PathRandom random(5, Stream::setup, 1, 0);
  on_surfaces(material, [&](const Bsdf& bsdf, const SurfacePoint& point) {
    for (const Vec3& wo : directions())
      for (const LobeSet lobes : subsets_of(bsdf.all_lobes()))
        for (const Transport transport : kTransports)
          for (int n = 0; n < 200; ++n) {
            const auto drawn = bsdf.sample(wo, three_numbers(random, n), transport, lobes);
            const std::string wrong = drawn ? fault(bsdf, point, wo, transport, lobes, *drawn) : "";
            if (!wrong.empty()) verdict.fail("from wo " + text(wo) + ", the sample " + text(drawn->wi) + " " + wrong);
          }
  });
  return verdict;
}

Verdict keeps_to_sides(const Material& material) {
  Verdict verdict;
  const PathRandom random(5, Stream::setup, 2, 0);
  const auto check = [&](const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo, const Vec3& wi,
                         Transport transport) {
    const LobeSet all = bsdf.all_lobes();
    const float pdf_w = bsdf.pdf_w(wo, wi, transport, all);
    const Spectrum f = bsdf.evaluate(wo, wi, transport, all);
    const auto wrong = [&](const std::string& what) {
      verdict.fail(fmt::format("wo {}, wi {}, {}: {}", text(wo), text(wi), text(transport), what));
    };
    if (!is_finite(f) || !std::isfinite(pdf_w) || !(pdf_w >= 0) || !(std::min({f[0], f[1], f[2]}) >= 0))
      wrong(fmt::format("f is {}, pdf_w {}", text(f), pdf_w));
    const Vec3& incident = transport == Transport::radiance ? wi : wo;  // where light comes from
    const bool sides_agree = dot(incident, point.ng) * dot(incident, point.ns) > 0;
    const bool through = dot(wi, point.ng) * dot(wo, point.ng) < 0;
    if (!sides_agree || (through && !bsdf.transmits(all))) {
      if (f != Spectrum(0) || pdf_w != 0) wrong("there should be no light, and no sample");
    } else if (!is_black(f) && pdf_w == 0) {
      wrong("evaluate is not 0 in directions that sample never draws");
    }
  };
  on_surfaces(material, [&](const Bsdf& bsdf, const SurfacePoint& point) {
    for (const Vec3& wo : directions())
      for (int n = 0; n < 500; ++n)
        for (const Transport transport : kTransports) check(bsdf, point, wo, any_direction(random, n), transport);
  });
  return verdict;
}

// On a bent surface, too, so that photons go where camera paths look for them.
Verdict is_reciprocal(const Material& material) {
  Verdict verdict;
  const PathRandom random(5, Stream::setup, 6, 0);
  on_surfaces(material, [&](const Bsdf& bsdf, const SurfacePoint& point) {
    const auto f = [&](const Vec3& wo, const Vec3& wi, Transport transport) {
      return bsdf.evaluate(wo, wi, transport, bsdf.all_lobes());
    };
    for (int n = 0; n < 2000; ++n) {
      const Vec3 wo = any_direction(random, n), wi = any_direction(random, 10'000 + n);
      const Spectrum back = f(wi, wo, Transport::radiance), flux = f(wo, wi, Transport::flux);
      const bool through = wo.z * wi.z < 0, plain = point.ns == point.ng;
      const bool equal = through || !plain || near(f(wo, wi, Transport::radiance), flux, 2e-3f);
      if (!near(flux, back, 2e-3f) || !equal)
        verdict.fail(fmt::format("between {} and {}{}: f is {} for flux, {} for radiance the other way round", text(wo),
                                 text(wi), plain ? "" : " on a bent surface", text(flux), text(back)));
    }
  });
  return verdict;
}

Verdict gains_nothing(const Material& material) {
  Verdict verdict;
  float most = 0;
  BsdfSlot slot;
  const Bsdf& bsdf = material.bsdf(surface(), slot);
  for (const Vec3& wo : directions()) {
    const Albedo a = albedo(bsdf, wo, Transport::flux, PathRandom(11, Stream::setup, 0, 0), 20'000);
    most = std::max(most, max_component(a.mean));
    for (int c = 0; c < 3; ++c)
      if (!(a.mean[c] <= 1 + 2e-3f + 4 * a.error[c]))
        verdict.fail(fmt::format("from wo {}, {} of the light comes back", text(wo), text(a.mean)));
  }
  if (verdict.passed) verdict.message = fmt::format("at most {:.3f} of the light comes back", most);
  return verdict;
}

Verdict check_scattering(const std::string& words) {
  const std::shared_ptr<const Material> material = material_of(words);
  Verdict all;
  for (const auto& check : {weights_agree, keeps_to_sides, is_reciprocal, gains_nothing}) {
    const Verdict verdict = check(*material);
    if (!verdict.passed) all.fail(verdict.message);
    if (all.passed && !verdict.message.empty()) all.message = verdict.message + "; ";
  }
  const Verdict chi2 = samples_follow_density(*material);
  if (!chi2.passed) all.fail(chi2.message);
  if (all.passed) all.message += chi2.message;
  return all;
}

Albedo albedo(const Bsdf& bsdf, const Vec3& wo, Transport transport, const PathRandom& random, int samples) {
  std::array<double, 3> sum{}, sum2{};
  for (int n = 0; n < samples; ++n) {
    Vec3 u = three_numbers(random, n);
    u.z =
        (static_cast<float>(n) + u.z) / static_cast<float>(samples);  // stratified, so that each lobe gets its fraction
    const auto drawn = bsdf.sample(wo, u, transport, bsdf.all_lobes());
    for (int c = 0; drawn && c < 3; ++c) {
      const auto weight = static_cast<double>(drawn->weight[c]);
      sum[static_cast<std::size_t>(c)] += weight, sum2[static_cast<std::size_t>(c)] += weight * weight;
    }
  }
  const auto mean = [&](std::size_t c) { return static_cast<float>(sum[c] / samples); };
  const auto error = [&](std::size_t c) {
    const double variance = sum2[c] / samples - sum[c] / samples * (sum[c] / samples);
    return static_cast<float>(std::sqrt(std::max(0., variance) / samples));
  };
  return {{mean(0), mean(1), mean(2)}, {error(0), error(1), error(2)}};
}

}  // namespace dspm::test
