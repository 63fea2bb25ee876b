// The translations from pbrt-v3 to v4, one for each kind of directive. Each changes types and parameters by a table of
// names, and computes where a number means something else. They throw SyntaxError for what has no counterpart.
#pragma once

#include <vector>

#include "dspm/lang/v3/edit.h"

namespace dspm::v3 {

void translate_material(Edit& edit);
void translate_texture(Edit& edit);
void translate_light(Edit& edit);
void translate_medium(Edit& edit);
void translate_shape(Edit& edit);
/// Camera, Film, Sampler, PixelFilter and Integrator.
void translate_option(Edit& edit);

/// The directives that replace each one from the start of a scene to WorldBegin.
using Header = std::vector<std::vector<Directive>>;
/// Moves what v4 says elsewhere: sppm's iterations are the Sampler's, a Film's speed includes the shutter. Adds v3's
/// defaults before WorldBegin, the last directive.
void settle_header(Header& header, Remarks& remarks);

}  // namespace dspm::v3
