// principled: one material for paint, plastic, metal, glass, varnish and cloth, as in Blender and glTF.
//
//   Material "principled" "rgb basecolor" [.6 .1 .1] "float roughness" 0.3 "float coat" 1
//
//   basecolor             spectrum texture    0.8    of the diffuse ground, of metal straight on, and (its root) of what
//                                                    passes a boundary of glass
//   metallic              float texture       0      share of metal; the rest is dielectric
//   transmission          float texture       0      share of glass in the dielectric; the rest is opaque
//   roughness             float texture       0.5    GGX alpha is its square
//   anisotropy            float texture       0      0 to 1: highlights are longer along the first tangent
//   eta (or ior)          float or spectrum   1.5    index of refraction of the dielectric, at least 1
//   specular              float texture       1      times what the opaque dielectric mirrors
//   coat                  float texture       0      share of the surface under a clear coat of index 1.5
//   coatroughness         float texture       0      as roughness
//   sheen                 spectrum texture    0      colour of fibres that reflect at grazing angles
//   sheenroughness        float texture       0.5    as roughness
//   attenuationcolor      spectrum            1      of white light after attenuationdistance in a body of glass
//   attenuationdistance   float               1      in world units
//
// From the top: sheen s, coat c, and a base. With E the directional albedo of a layer by the cosine to the normal, a
// layer leaves 1 - s E_s and 1 - c E_c to what is below. The base is
//   metal:    GGX with Schlick's Fresnel term, and a diffuse lobe for light that meets several facets, f =
//             F' (1 - E(o)) (1 - E(i)) / (pi (1 - mean E)) [Kulla and Conty 2017];
//   glass:    GGX, both ways, with the same lobe (F' = 1) for what its facets lose;
//   opaque:   GGX over a diffuse ground, which gets what all layers leave, on the way in and out:
//             f = basecolor X(o) X(i) / (pi mean X), X = (1 - specular E) (1 - c E_c) (1 - s E_s).
// Light that is mirrored below coat or sheen keeps the lesser of what they leave for o and for i. So f is reciprocal,
// and a white base gives back all light: with no coat over metal or glass, to within the 0.3% of the tables of E.
// Both sides scatter alike; through a share of glass, the inside is the side away from the geometric normal.
// Not there: thin walls, subsurface scattering, a tint of the dielectric's reflection, iridescence. Light that comes
// from the surface itself is an AreaLightSource of its shape.
// [Burley 2012, 2015; glTF 2.0, appendix B and KHR_materials_clearcoat, _ior, _sheen, _specular, _transmission, _volume;
// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF]
#include <algorithm>
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/principled_bsdf.h"
#include "dspm/materials/principled_tables.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {
namespace {

constexpr float kLeastEta = 1.01f;  // rough boundaries of less hardly bend light, and rounding decides where it goes

float square(float x) { return x * x; }

struct Reader {
  ParamReader& params;
  const MaterialContext& context;

  TexturePtr<float> share(std::string_view name, float fallback, std::string_view sentence) {
    const auto value = params.number_or_texture(name, fallback, "", sentence);
    if (!(value.value >= 0 && value.value <= 1))
      params.error(name, "parameter \"" + std::string(name) + "\" of " + params.subject() + " must lie in [0, 1]");
    return texture_of(value, context.textures, params.diagnostics());
  }
  TexturePtr<Rgb> colour(std::string_view name, float fallback, std::string_view sentence) {
    const auto value = params.rgb_or_texture(name, Rgb(fallback), SpectrumRole::albedo, sentence);
    return texture_of(value, context.textures, params.diagnostics());
  }
};

class PrincipledMaterial final : public Material {
 public:
  PrincipledMaterial(ParamReader& reader, const MaterialContext& context) {
    Reader read{reader, context};
    base_ =
        read.colour("basecolor", 0.8f, "of the diffuse ground, of metal straight on, its root of what passes glass");
    metallic_ = read.share("metallic", 0, "share of metal; the rest is dielectric");
    transmission_ = read.share("transmission", 0, "share of glass in the dielectric; the rest is opaque");
    roughness_ = read.share("roughness", 0.5f, "GGX alpha is its square");
    anisotropy_ = read.share("anisotropy", 0, "0 to 1: highlights are longer along the first tangent");
    reader.alias("ior", "eta");
    const float eta = read_eta(reader);
    if (eta < 1) reader.error("eta", "parameter \"eta\" of " + reader.subject() + " must be at least 1");
    specular_ = read.share("specular", 1, "times what the opaque dielectric mirrors");
    coat_ = read.share("coat", 0, "share of the surface under a clear coat of index 1.5");
    coat_roughness_ = read.share("coatroughness", 0, "as roughness");
    sheen_ = read.colour("sheen", 0, "of fibres that reflect at grazing angles");
    sheen_roughness_ = read.share("sheenroughness", 0.5f, "as roughness");
    absorption_ = read_absorption(reader);
    eta_ = std::max(eta, kLeastEta);
  }

  /// After the parameters have been checked.
  void make_tables() { tables_ = principled_tables(eta_); }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    const auto number = [&](const TexturePtr<float>& texture) { return std::clamp(texture->evaluate(at), 0.f, 1.f); };
    const float alpha = square(number(roughness_));
    const float aspect = std::sqrt(1 - 0.9f * number(anisotropy_));  // [Burley 2012]
    const PrincipledLook look{clamped_albedo(base_->evaluate(at)),
                              number(metallic_),
                              number(specular_),
                              number(transmission_),
                              {std::min(1.f, alpha / aspect), alpha * aspect},
                              number(coat_),
                              square(number(coat_roughness_)),
                              clamped_albedo(sheen_->evaluate(at)),
                              square(number(sheen_roughness_))};
    return slot.emplace<Principled>(ShadingFrame(point), *tables_, look);
  }
  bool bounds_a_body() const override { return transmission_->constant() != 0.f; }
  Rgb absorption() const override { return absorption_; }

 private:
  TexturePtr<Rgb> base_, sheen_;
  TexturePtr<float> metallic_, transmission_, roughness_, anisotropy_, specular_, coat_, coat_roughness_,
      sheen_roughness_;
  float eta_;
  Rgb absorption_;
  std::shared_ptr<const PrincipledTables> tables_;
};

}  // namespace

std::unique_ptr<Material> make_principled(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<PrincipledMaterial>(reader, context);
  reader.unsupported("emission", "light comes from the AreaLightSource of a shape");
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
