// principled: one material for paint, plastic, metal, glass, varnish and cloth, as in Blender and glTF.
//
//   Material "principled" "rgb basecolor" [.6 .1 .1] "float roughness" 0.3 "float coat" 1
//
//   basecolor             spectrum texture    0.8    of the diffuse ground, of metal straight on, and (its root) of what
//                                                    passes a boundary of glass
//   metallic              float texture       0      share of metal; the rest is dielectric
//   transmission          float texture       0      share of glass in the dielectric; the rest is opaque
//   thin                  bool                false  a wall without a body: what passes is not bent, and not absorbed
//   diffusetransmission   float texture       0      share of the diffuse ground's light that leaves on the other side
//   diffusetransmissioncolor   spectrum texture   basecolor   of that light
//   roughness             float texture       0.5    GGX alpha is its square
//   anisotropy            float texture       0      0 to 1: highlights are longer along the first tangent
//   anisotropyrotation    float texture       0      degrees, from the first tangent towards the second
//   eta (or ior)          float or spectrum   1.5    index of refraction of the dielectric, at least 1
//   abbe, glass           float, string       none   as those of dielectric.cpp, for a body of glass
//   specular              float texture       1      times what the opaque dielectric mirrors
//   specularcolor         spectrum texture    1      of that, straight on, where no more than all light is mirrored: may
//                                                    exceed 1; at grazing angles it is white
//   coat                  float texture       0      share of the surface under a clear coat of index 1.5
//   coatroughness         float texture       0      as roughness
//   coatnormaltexture     texture         none    colours of normals for the coat, as the material's normaltexture
//   coatnormalscale       float           1       times the slopes of those normals
//   iridescence           float texture   0       share of the surface under a thin film, whose colours are interference
//   iridescencethickness  float texture   400     of the film, in nanometres
//   iridescenceeta        float           1.3     its index of refraction, at least 1
//   sheen                 spectrum texture    0      colour of fibres that reflect at grazing angles
//   sheenroughness        float texture       0.5    as roughness
//   attenuationcolor      spectrum            1      of white light after attenuationdistance in a body of glass
//   attenuationdistance   float               1      in world units
//   alpha                 float texture       1      as of shapes: the fraction of rays that the surface stops
//   emission              spectrum texture    0      colour of the light that both sides emit
//   emissionstrength      float               1      times emission: radiance
//
// From the top: sheen s, coat c, and a base. With E the directional albedo of a layer by the cosine to the normal,
// sheen and coat leave X = (1 - s E_s) (1 - c E_c) to what is below. The base is
//   metal:    GGX with Schlick's Fresnel term, and a diffuse lobe for light that meets several facets, f =
//             F' (1 - E(o)) (1 - E(i)) / (pi (1 - mean E)) [Kulla and Conty 2017];
//   glass:    GGX, both ways, with the same lobe (F' = 1) for what its facets lose;
//   opaque:   GGX over a diffuse ground, which gets what all layers leave, on the way in and out:
//             f = basecolor Y(o) Y(i) / (pi mean Y), Y = (1 - specular E) X; of that, 1 - diffusetransmission on this
//             side, and the rest, with its own colour, on the other.
// E of facets of two roughnesses depends on the azimuth (brushed_albedo.h). Of light that facets below coat or sheen
// mirror, a(o) a(i) passes both ways, a = X / sqrt(M), where M goes from X for mirrors to means of X for rough facets,
// as the ground has it (layer_balance.h). Of what passes glass, X(o) does, for o outside, and from inside glass mirrors
// what layers send back. So f is reciprocal, and white gives back all light, to within
//   0.3%       of bare facets, 1% of rough glass from inside (tables of E);
//   1% to 2%   of brushed facets, 5% of brushed glass from inside, at anisotropy 1 (tables of E);
//   1.5%       of metal and panes under coat and sheen, 2% of the opaque dielectric, 5% if brushed as well (M is that of
//              white metal with one roughness);
//   9%         of rough glass under white sheen, 6% under a coat, from inside, and nothing of smooth glass (what is sent
//              back is mirrored as if facets did not spread it).
// Both sides scatter alike; through a share of glass, the inside is the side away from the geometric normal. A thin
// wall of glass is seen from outside on both sides: light that passes leaves as if a facet had mirrored it and the wall
// had mirrored it again, times basecolor, which it crosses once, whatever its thickness.
// Alpha makes holes for camera paths, shadow rays and photons, times the alpha of the shape, and emission makes each
// shape of the material an area light, which nothing above it dims; a shape's AreaLightSource takes its place. A `mix`
// has both by the share of its part.
// A thin film lies between coat and base, and changes what facets of the base mirror (thin_film.h); the ground gets
// what the film leaves of its brightest colour, which takes up to 17% of white, and frosted glass makes up for what its
// facets lose at the film's mean reflectance, to 2%. The coat follows the shape, whatever the normal map of the base,
// unless it has normals of its own. A mirror whose normal leans so far that the camera would see it mirror the surface
// itself is bent until it does not (tilt.h).
// If the index of glass differs with the wavelength, light that passes it is refracted by that of the iteration
// (wavelength.h); what facets mirror outside keeps all colours.
// Not there: subsurface scattering.
// [Burley 2012, 2015; glTF 2.0, appendix B and KHR_materials_anisotropy, _clearcoat, _diffuse_transmission,
// _emissive_strength, _ior, _iridescence, _sheen, _specular, _transmission, _volume;
// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/material.h"
#include "dspm/materials/normal_map.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/per_surroundings.h"
#include "dspm/materials/principled/principled_bsdf.h"
#include "dspm/materials/principled/principled_tables.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/materials/shading_frame.h"

namespace dspm {
namespace {

constexpr float kLeastEta = 1.01f;  // rough boundaries of less hardly bend light, and rounding decides where it goes

float away_from_one(float eta, bool less) { return less ? std::min(eta, 1 / kLeastEta) : std::max(eta, kLeastEta); }

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
  TexturePtr<float> number(std::string_view name, std::string_view unit, std::string_view sentence) {
    return texture_of(params.number_or_texture(name, 0, unit, sentence), context.textures, params.diagnostics());
  }
  TexturePtr<Rgb> colour(std::string_view name, float fallback, std::string_view sentence,
                         SpectrumRole role = SpectrumRole::albedo) {
    const auto value = params.rgb_or_texture(name, Rgb(fallback), role, sentence);
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
    thin_ = reader.flag("thin", false, "a wall without a body: what passes is not bent, and not absorbed");
    beyond_ = read.share("diffusetransmission", 0, "share of the diffuse ground's light that leaves on the other side");
    beyond_colour_ = read.colour("diffusetransmissioncolor", 0.8f, "of that light; basecolor if not given");
    if (!reader.has("diffusetransmissioncolor")) beyond_colour_ = base_;
    anisotropy_ = read.share("anisotropy", 0, "0 to 1: highlights are longer along the first tangent");
    rotation_ = read.number("anisotropyrotation", "degrees", "of that tangent, towards the second");
    reader.alias("ior", "eta");
    index_ = read_refractive_index(reader);
    const float eta = index_.mean();
    if (index_.lowest() < 1) reader.error("eta", "parameter \"eta\" of " + reader.subject() + " must be at least 1");
    specular_ = read.share("specular", 1, "times what the opaque dielectric mirrors");
    specular_colour_ =
        read.colour("specularcolor", 1, "of that, straight on; at grazing angles it is white", SpectrumRole::unbounded);
    coat_ = read.share("coat", 0, "share of the surface under a clear coat of index 1.5");
    coat_roughness_ = read.share("coatroughness", 0, "as roughness");
    coat_relief_ = read_coat_relief(reader, context);
    iridescence_ = read.share("iridescence", 0, "share of the surface under a thin film");
    film_nm_ = texture_of(reader.number_or_texture("iridescencethickness", 400, "nanometres", "of that film"),
                          context.textures, reader.diagnostics());
    film_eta_ = reader.number("iridescenceeta", 1.3f, "", "the film's index of refraction");
    if (!(film_eta_ >= 1))
      reader.error("iridescenceeta", "parameter \"iridescenceeta\" of " + reader.subject() + " must be at least 1");
    sheen_ = read.colour("sheen", 0, "of fibres that reflect at grazing angles");
    sheen_roughness_ = read.share("sheenroughness", 0.5f, "as roughness");
    absorption_ = Absorption(reader);
    if (thin_ && !absorption_.is_none())
      reader.error("attenuationcolor", reader.subject() + " is thin, so it has no inside that absorbs light",
                   "\"basecolor\" colours what passes a thin wall");
    // World makes use of them.
    texture_of(read_opacity(reader), context.textures, reader.diagnostics());
    texture_of(read_emission_look(reader).colour, context.textures, reader.diagnostics());
    eta_ = std::max(eta, kLeastEta);
    if (index_.disperses() && !bounds_a_body())
      for (const char* name : {"eta", "glass", "abbe"})
        if (reader.has(name))
          reader.diagnostics().note(reader.where(name),
                                    fmt::format("{} has no dispersion: eta is {:.4g}", reader.subject(), eta),
                                    "only a body of glass, with \"transmission\" and not \"thin\", has it");
  }

  /// Call this after the parameters have been checked.
  void make_tables() {
    const bool layers = coat_->constant() != 0.f || sheen_->constant() != Rgb(0);
    const PrincipledUses uses{anisotropy_->constant() != 0.f, transmission_->constant() != 0.f, layers};
    tables_.emplace([this, uses](float outside) {
      const float eta = eta_ / outside;
      return principled_tables(away_from_one(eta, eta < 1), thin_, film_eta_, uses);
    });
    is_linear_ = metallic_->constant() == 0.f && transmission_->constant() == 0.f && !coat_relief_ &&
                 is_same_everywhere(beyond_, roughness_, anisotropy_, rotation_, specular_, specular_colour_, coat_,
                                    coat_roughness_, sheen_, sheen_roughness_, iridescence_, film_nm_) &&
                 base_->averages() && beyond_colour_->averages();
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    const auto number = [&](const TexturePtr<float>& texture) { return std::clamp(texture->evaluate(at), 0.f, 1.f); };
    const float alpha = square(number(roughness_));
    const float aspect = std::sqrt(1 - 0.9f * number(anisotropy_));  // [Burley 2012]
    const PrincipledLook look{clamped_albedo(base_->carried(at)),
                              number(metallic_),
                              number(specular_),
                              clamped_albedo(specular_colour_->carried(at) * fresnel_dielectric(1, eta_)),
                              number(transmission_),
                              number(beyond_),
                              clamped_albedo(beyond_colour_->carried(at)),
                              {std::min(1.f, alpha / aspect), alpha * aspect},
                              number(coat_),
                              square(number(coat_roughness_)),
                              clamped_albedo(sheen_->carried(at)),
                              square(number(sheen_roughness_)),
                              coat_normal(point),
                              number(iridescence_),
                              std::max(0.f, film_nm_->evaluate(at))};
    const PrincipledTables& tables = tables_->of(point.outside_eta);
    Refraction refraction(index_, point);
    refraction.eta = refraction.disperses() ? away_from_one(refraction.eta, tables.eta < 1) : tables.eta;
    return slot.emplace<Principled>(frame(point, rotation_->evaluate(at)), tables, refraction, *point.palette, look);
  }
  /// Only the ground is linear, in its two colours.
  bool is_linear() const override { return is_linear_; }
  bool bounds_a_body() const override { return !thin_ && transmission_->constant() != 0.f; }
  float eta() const override { return eta_; }
  float eta_at(const Wavelength& wavelength) const override {
    return index_.disperses() ? index_.at(wavelength) : eta_;
  }
  bool disperses() const override { return index_.disperses() && bounds_a_body(); }
  Spectrum absorption(const Palette& palette) const override { return absorption_.per_length(palette); }

 private:
  template <class... Textures>
  static bool is_same_everywhere(const Textures&... textures) {
    return (... && textures->constant().has_value());
  }

  static ShadingFrame frame(const SurfacePoint& point, float degrees) {
    if (degrees == 0) return ShadingFrame(point);
    Basis basis = Basis::around(point.ns, point.dpdu);
    if (dot(basis.y, point.dpdv) < 0) basis.y = -basis.y;  // mirrored coordinates, or a mirrored world
    SurfacePoint turned = point;
    turned.dpdu = basis.x * rounded::cos(degrees * kPi / 180) + basis.y * rounded::sin(degrees * kPi / 180);
    return ShadingFrame(turned);
  }

  Vec3 coat_normal(const SurfacePoint& point) const {
    SurfacePoint smooth = point;
    if (length2(point.smooth_ns) > 0) smooth.ns = point.smooth_ns;
    if (!coat_relief_) return smooth.ns;
    const Vec3 n = normalize(coat_relief_->leaning(smooth));
    return is_finite(n) && dot(n, point.ng) > 0 ? n : smooth.ns;
  }

  TexturePtr<Rgb> base_, beyond_colour_, specular_colour_, sheen_;
  std::shared_ptr<const NormalMap> coat_relief_;
  TexturePtr<float> iridescence_, film_nm_;
  TexturePtr<float> metallic_, transmission_, beyond_, roughness_, anisotropy_, rotation_, specular_, coat_,
      coat_roughness_, sheen_roughness_;
  bool thin_, is_linear_ = false;
  RefractiveIndex index_{1.5f};
  float eta_, film_eta_;
  Absorption absorption_;
  std::optional<PerSurroundings<PrincipledTables>> tables_;
};

}  // namespace

std::unique_ptr<Material> make_principled(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<PrincipledMaterial>(reader, context);
  reader.finish();
  material->make_tables();
  return material;
}

}  // namespace dspm
