// The checks of materials tell what is wrong with one.
#include "dspm/testing/scattering.h"

#include <gtest/gtest.h>

#include "dspm/base/math/sampling.h"
#include "dspm/base/params/errors.h"
#include "dspm/materials/shading_frame.h"

namespace dspm::test {
namespace scattering_test {

enum class Fault { none, density, weight, gain, one_way, no_number, wrong_side };

/// White and matte, but for one fault.
class Faulty final : public Bsdf {
 public:
  Faulty(const SurfacePoint& point, Fault fault) : frame_(point), ng_(point.ng), fault_(fault) {}

  LobeSet lobes(float) const override { return 1; }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair pair(frame_, wo, wi, transport);
    if (fault_ == Fault::wrong_side && (lobes & 1)) return Spectrum(1 / kPi);
    if (!(lobes & 1) || !pair.reflection()) return Spectrum(0);
    if (fault_ == Fault::no_number && pair.wi.z < 0.1f) return Spectrum(kInfinity);
    return Spectrum(value(pair.wo.z));
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair pair(frame_, wo, wi, transport);
    return (lobes & 1) && pair.reflection() ? pair.share * density(pair.wi.z) : 0;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const float cos_o = arriving->z;
    const Vec3 local = cosine_hemisphere({u.x, u.y});
    const auto leaving = frame_.leave(local, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const float pdf_w = leaving->share * density(local.z), weight = value(cos_o) * local.z / pdf_w;
    return BsdfSample{leaving->wi, Spectrum(fault_ == Fault::weight ? 0.9f * weight : weight), pdf_w, false};
  }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

 private:
  float value(float cos_o) const {
    if (fault_ == Fault::gain) return 1.02f / kPi;
    return (fault_ == Fault::one_way ? 0.5f + 0.5f * cos_o : 1) / kPi;
  }
  float density(float cos_i) const {
    const float right = cosine_hemisphere_pdf_w(cos_i);
    return fault_ == Fault::density ? right * (0.9f + 0.15f * cos_i) : right;  // its integral is 1, too
  }

  ShadingFrame frame_;
  Vec3 ng_;
  Fault fault_;
};

class FaultyMaterial final : public Material {
 public:
  explicit FaultyMaterial(Fault fault) : fault_(fault) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<Faulty>(point, fault_);
  }

 private:
  Fault fault_;
};

/// Passes by the checks: density, weights, sides, reciprocity, energy.
std::vector<bool> passes(Fault fault) {
  const FaultyMaterial m(fault);
  return {samples_follow_density(m).passed, weights_agree(m).passed, keeps_to_sides(m).passed, is_reciprocal(m).passed,
          gains_nothing(m).passed};
}

TEST(ScatteringChecks, TellWhatIsWrong) {
  EXPECT_EQ(passes(Fault::none), (std::vector<bool>{true, true, true, true, true}));
  EXPECT_EQ(passes(Fault::density), (std::vector<bool>{false, true, true, true, true}));
  EXPECT_EQ(passes(Fault::weight), (std::vector<bool>{true, false, true, true, true}));
  EXPECT_EQ(passes(Fault::gain), (std::vector<bool>{true, true, true, true, false}));
  EXPECT_EQ(passes(Fault::one_way), (std::vector<bool>{true, true, true, false, true}));
  EXPECT_FALSE(passes(Fault::no_number)[2]);
  EXPECT_FALSE(passes(Fault::wrong_side)[2]);
}

TEST(ScatteringChecks, OfWordsInAScene) {
  const Verdict verdict = check_scattering(R"("coateddiffuse" "float roughness" 0.3)");
  EXPECT_TRUE(verdict.passed) << verdict.message;
  EXPECT_NE(verdict.message.find("87 tests"), std::string::npos) << verdict.message;
  EXPECT_THROW(check_scattering(R"("diffuse" "float roughnes" 1)"), SceneError);
}

}  // namespace scattering_test
}  // namespace dspm::test
