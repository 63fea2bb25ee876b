// Tone curves: from radiance to linear light of a screen. docs/looking.md describes them.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "dspm/base/colour/rgb.h"

namespace dspm {

enum class ViewCurve {
  standard,    // each component clipped at 1, as pbrt does
  filmic,      // Hable 2010
  agx,         // Sobotka's AgX
  agx_punchy,  // with a look that deepens it
  agx_golden,  // with a warm look
  neutral,     // Khronos PBR Neutral
  aces,        // Hill's fit of ACES
  raw          // the numbers themselves, clipped and never encoded
};

inline constexpr ViewCurve kUsualView = ViewCurve::agx;
inline constexpr std::pair<ViewCurve, std::string_view> kViewNames[] = {{ViewCurve::standard, "standard"},
                                                                        {ViewCurve::filmic, "filmic"},
                                                                        {ViewCurve::agx, "agx"},
                                                                        {ViewCurve::agx_punchy, "agx-punchy"},
                                                                        {ViewCurve::agx_golden, "agx-golden"},
                                                                        {ViewCurve::neutral, "neutral"},
                                                                        {ViewCurve::aces, "aces"},
                                                                        {ViewCurve::raw, "raw"}};
std::optional<ViewCurve> view_curve(std::string_view name);

/// Rec. 709 on both sides, the result in 0..1. NaN and negative values count as 0.
Rgb curved(ViewCurve curve, const Rgb& radiance);

}  // namespace dspm
