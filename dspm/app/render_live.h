// `--serve`: a render whose page shows it, and that begins anew whenever its scene is edited.
#pragma once

#include "dspm/app/options.h"
#include "dspm/machines/link.h"

namespace dspm {

/// Returns and throws as render_scene() does. A scene with errors does not end it, nor does another machine that cannot
/// read it: they stand on the page until they are mended.
int render_live(Options options, Link* others = nullptr);

}  // namespace dspm
