// `--serve`: a render whose page shows it, and that begins anew whenever its scene is edited.
#pragma once

#include "dspm/app/options/options.h"
#include "dspm/session/machines/link.h"

namespace dspm {

/// Returns and throws what render_scene() does. Neither a scene with errors ends it, nor another machine that cannot
/// read it: they stand on the page until they are mended.
int render_live(Options options, Link* others = nullptr);

}  // namespace dspm
