// Translates what pbrt-v3 says before WorldBegin: camera, film, sampler, filter and integrator.
#include <algorithm>
#include <cmath>
#include <span>

#include "dspm/lang/v3/kinds.h"

namespace dspm::v3 {
namespace {

constexpr std::string_view kSamples = "pixelsamples", kIterations = "iterations", kSimpleWeighting = "simpleweighting";

// clang-format off
constexpr Rule kCameras[] = {
    {"perspective", "", "fov halffov lensradius focaldistance frameaspectratio screenwindow shutteropen shutterclose"},
    {"orthographic", "", "lensradius focaldistance frameaspectratio screenwindow shutteropen shutterclose"},
    {"environment", "spherical", "lensradius= focaldistance= frameaspectratio= screenwindow= shutteropen shutterclose"},
    {"realistic", "", "lensfile aperturediameter focusdistance simpleweighting shutteropen shutterclose"},
};
constexpr Rule kFilms[] = {
    {"image", "rgb", "filename xresolution:integer640 yresolution:integer480 cropwindow diagonal scale "
                     "maxsampleluminance=maxcomponentvalue"},
};
constexpr Rule kSamplers[] = {
    {"halton", "", "pixelsamples samplepixelcenter="},
    {"sobol", "", "pixelsamples"},
    {"random", "independent", "pixelsamples"},
    {"02sequence", "paddedsobol", "pixelsamples dimensions="},
    {"zerotwosequence", "paddedsobol", "pixelsamples dimensions="},
    {"lowdiscrepancy", "paddedsobol", "pixelsamples dimensions="},
    {"maxmindist", "pmj02bn", "pixelsamples dimensions="},
    {"stratified", "", "jitter xsamples ysamples dimensions="},
};
constexpr Rule kFilters[] = {
    {"box", "", "xwidth=xradius:float.5 ywidth=yradius:float.5"},
    {"triangle", "", "xwidth=xradius:float2 ywidth=yradius:float2"},
    {"gaussian", "", "xwidth=xradius:float2 ywidth=yradius:float2 alpha:float2"},
    {"mitchell", "", "xwidth=xradius:float2 ywidth=yradius:float2 B C"},
    {"sinc", "", "xwidth=xradius:float4 ywidth=yradius:float4 tau"},
};
constexpr Rule kIntegrators[] = {
    {"path", "", "maxdepth pixelbounds= rrthreshold= lightsamplestrategy="},
    {"volpath", "", "maxdepth pixelbounds= rrthreshold= lightsamplestrategy="},
    {"directlighting", "path", "maxdepth strategy= pixelbounds="},
    {"whitted", "path", "maxdepth pixelbounds="},
    {"bdpt", "", "maxdepth pixelbounds= lightsamplestrategy= visualizestrategies visualizeweights"},
    {"mlt", "", "maxdepth bootstrapsamples chains mutationsperpixel largestepprobability sigma"},
    {"sppm", "", "maxdepth numiterations=iterations iterations:integer64 photonsperiteration radius "
                 "imagewritefrequency="},
    {"ambientocclusion", "", "cossample nsamples= maxdistance pixelbounds="},
};
// clang-format on

std::span<const Rule> rules_of(DirectiveKind kind) {
  switch (kind) {
    case DirectiveKind::camera: return kCameras;
    case DirectiveKind::film: return kFilms;
    case DirectiveKind::sampler: return kSamplers;
    case DirectiveKind::pixel_filter: return kFilters;
    case DirectiveKind::integrator: return kIntegrators;
    default: return {};
  }
}

void finish_option(Edit& edit, std::string_view from) {
  if (from == "environment") edit.set(ParamType::text, "mapping", std::vector<std::string>{"equirectangular"});
  if (from == "realistic" && edit.find(kSimpleWeighting) == nullptr)
    edit.set(ParamType::boolean, std::string(kSimpleWeighting), std::vector<bool>{true});
  if (const auto half = edit.number("halffov")) {
    edit.take("halffov");
    edit.set_number("fov", 2 * *half);
  }
  if (from == "image" && edit.find("maxcomponentvalue") != nullptr)
    edit.only_close("maxsampleluminance (bounds each component)");
  if (const auto alpha = edit.number("alpha"); alpha && from == "gaussian") {
    edit.take("alpha");
    edit.set_number("sigma", 1 / std::sqrt(2 * std::max(*alpha, 1e-6f)));
  }
  if (from == "directlighting" || from == "whitted") edit.set(ParamType::boolean, "indirect", std::vector<bool>{false});
}

Directive* find_in(Header& header, DirectiveKind kind) {
  for (std::vector<Directive>& group : header)
    for (Directive& directive : group)
      if (directive.info->kind == kind) return &directive;
  return nullptr;
}

float shutter_seconds(Header& header, Remarks& remarks) {
  Directive* const camera = find_in(header, DirectiveKind::camera);
  if (camera == nullptr) return 1;
  const Edit edit(*camera, remarks);
  // Weights of such a lens count the shutter in v3, too.
  const Param* simple = edit.find(kSimpleWeighting);
  if (simple != nullptr && simple->values == Param::Values(std::vector<bool>{false})) return 1;
  const float seconds = edit.number("shutterclose").value_or(1) - edit.number("shutteropen").value_or(0);
  return seconds > 0 ? seconds : 1;
}

/// Translates the film's speed: v3 multiplies by "scale", v4 by the seconds of the shutter and iso / 100.
void settle_speed(Header& header, Remarks& remarks) {
  Directive* const film = find_in(header, DirectiveKind::film);
  if (film == nullptr) return;
  Edit edit(*film, remarks);
  const float iso = 100 * edit.number("scale").value_or(1) / shutter_seconds(header, remarks);
  edit.take("scale");
  if (iso != 100) edit.set_number("iso", iso);
}

/// Makes as many iterations of sppm as the sampler takes samples.
void settle_iterations(Header& header, Remarks& remarks) {
  Directive* const integrator = find_in(header, DirectiveKind::integrator);
  if (integrator == nullptr) return;
  Edit edit(*integrator, remarks);
  auto iterations = edit.take(kIterations);
  if (!iterations) return;
  for (std::vector<Directive>& group : header)
    std::erase_if(group, [](const Directive& each) { return each.info->kind == DirectiveKind::sampler; });
  iterations->name = kSamples;
  Directive sampler = edit.make("Sampler", {"halton"});
  sampler.params.params.push_back(*std::move(iterations));
  header.back().insert(header.back().begin(), std::move(sampler));
}

}  // namespace

void translate_option(Edit& edit) {
  const std::string from = edit.type();
  const auto rules = rules_of(edit.directive().info->kind);
  const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule& each) { return each.from == from; });
  if (rule == rules.end()) return;
  edit.apply(*rule);
  finish_option(edit, from);
}

void settle_header(Header& header, Remarks& remarks) {
  settle_speed(header, remarks);
  settle_iterations(header, remarks);
  Directive world = header.back().back();
  const Edit at_world(world, remarks);
  const auto add = [&](const Directive& directive) { header.back().insert(header.back().begin(), directive); };
  if (find_in(header, DirectiveKind::pixel_filter) == nullptr) add(at_world.make("PixelFilter", {"box"}));
  if (find_in(header, DirectiveKind::film) == nullptr) {
    Directive film = at_world.make("Film", {"image"});
    Edit edit(film, remarks);
    translate_option(edit);
    add(film);
  }
}

}  // namespace dspm::v3
