#include "dspm/lang/old_pbrt.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace dspm {
namespace {

using Words = std::span<const std::string_view>;

bool among(std::string_view word, Words words) { return std::find(words.begin(), words.end(), word) != words.end(); }

// Only pbrt-v1 and v2 have these, except that v3 has the last one.
constexpr std::string_view kOldDirectives[] = {"SurfaceIntegrator", "VolumeIntegrator", "Volume",
                                               "Renderer",          "SearchPath",       "WorldEnd"};

// Plugins that pbrt-v4 dropped or renamed.
constexpr std::string_view kCameras[] = {"environment"};
constexpr std::string_view kFilms[] = {"image"};
constexpr std::string_view kSamplers[] = {"lowdiscrepancy", "02sequence", "zerotwosequence", "random",
                                          "bestcandidate",  "adaptive",   "maxmindist"};
constexpr std::string_view kIntegrators[] = {"directlighting", "whitted", "ao"};
constexpr std::string_view kAccelerators[] = {"grid"};
constexpr std::string_view kLights[] = {"exinfinite", "infinitesample"};
constexpr std::string_view kAreaLights[] = {"area"};
constexpr std::string_view kShapes[] = {"cone", "hyperboloid", "paraboloid", "heightfield", "heightfield2", "nurbs"};
constexpr std::string_view kMaterials[] = {
    "matte",   "plastic",      "glass",     "mirror",       "metal", "uber", "disney", "substrate", "translucent",
    "fourier", "kdsubsurface", "bluepaint", "brushedmetal", "clay",  "felt", "primer", "skin",      "shinymetal"};
constexpr std::string_view kTextures[] = {"uv"};
constexpr std::string_view kMedia[] = {"heterogeneous"};

// Of all these, those that v3 did not have either.
constexpr std::string_view kBeforeV3[] = {"SurfaceIntegrator",
                                          "VolumeIntegrator",
                                          "Volume",
                                          "Renderer",
                                          "SearchPath",
                                          "bestcandidate",
                                          "adaptive",
                                          "grid",
                                          "ao",
                                          "exinfinite",
                                          "infinitesample",
                                          "heightfield2",
                                          "bluepaint",
                                          "brushedmetal",
                                          "clay",
                                          "felt",
                                          "primer",
                                          "skin",
                                          "shinymetal"};

// Parameters that pbrt-v4 renamed or reads differently, whatever they belong to.
constexpr std::string_view kParams[] = {
    "Kd", "Ks", "Kr", "Kt", "mapname", "bumpmap", "xwidth", "ywidth", "nlevels", "namedmaterial1", "namedmaterial2"};

Words old_types(DirectiveKind kind) {
  switch (kind) {
    case DirectiveKind::camera: return kCameras;
    case DirectiveKind::film: return kFilms;
    case DirectiveKind::sampler: return kSamplers;
    case DirectiveKind::integrator: return kIntegrators;
    case DirectiveKind::accelerator: return kAccelerators;
    case DirectiveKind::light_source: return kLights;
    case DirectiveKind::area_light_source: return kAreaLights;
    case DirectiveKind::shape: return kShapes;
    case DirectiveKind::material:
    case DirectiveKind::make_named_material: return kMaterials;
    case DirectiveKind::texture: return kTextures;
    case DirectiveKind::make_named_medium: return kMedia;
    default: return {};
  }
}

/// Returns the directive's plugin type: its last word, or the value of "string type".
std::optional<OldWord> type_of(const Directive& directive) {
  if (directive.info->name.starts_with("MakeNamed")) {
    const auto& params = directive.params.params;
    const auto type = std::find_if(params.begin(), params.end(), [](const Param& p) { return p.name == "type"; });
    if (type == params.end()) return std::nullopt;
    const auto* texts = std::get_if<std::vector<std::string>>(&type->values);
    if (texts == nullptr || texts->empty()) return std::nullopt;
    return OldWord{texts->front(), type->values_where};
  }
  if (directive.words.empty()) return std::nullopt;
  return OldWord{directive.words.back().text, directive.words.back().where};
}

bool is_written_with(const SourceFile& file, std::string_view word) {
  return file.text.find(word) != std::string::npos;
}

}  // namespace

bool is_old_directive(std::string_view name) { return among(name, kOldDirectives); }

std::optional<OldWord> old_word_in(const Directive& directive) {
  const auto type = type_of(directive);
  if (type && among(type->word, old_types(directive.info->kind))) return type;
  if (directive.info->kind == DirectiveKind::texture && directive.words[1].text == "color")
    return OldWord{"color", directive.words[1].where};
  for (const Param& param : directive.params.params)
    if (among(param.name, kParams)) return OldWord{param.name, param.where};
  return std::nullopt;
}

bool is_certainly_new(const Directive& directive) {
  constexpr std::string_view kNewFilms[] = {"rgb", "gbuffer", "spectral"};
  return directive.info->kind == DirectiveKind::frames ||
         (directive.info->kind == DirectiveKind::film && among(directive.words[0].text, kNewFilms));
}

bool is_before_v3(const OldWord& sign) {
  const SourceFile& file = *sign.where.file;
  return among(sign.word, kBeforeV3) || is_written_with(file, "SurfaceIntegrator") ||
         is_written_with(file, "VolumeIntegrator") || is_written_with(file, "\nRenderer");
}

SyntaxError old_pbrt_error(const OldWord& sign) {
  return {sign.where,
          fmt::format(
              "this is a scene for pbrt-v1 or v2; dspm reads the formats of pbrt-v4 and v3, which do not know \"{}\"",
              sign.word),
          "pbrt-v3's documentation explains how to convert it to v3"};
}

}  // namespace dspm
