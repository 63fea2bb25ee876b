// The first pictures of a live page: a few iterations of a quarter of the size, with fewer photons, which start without
// what a render learns about where they should.
#pragma once

#include "dspm/app/options.h"
#include "dspm/serve/live_page.h"

namespace dspm {

/// Ends early if `page` wants an end. Throws SceneError if the scene cannot be rendered.
void show_coarsely(const Options& options, LivePage& page, Messages& messages);

}  // namespace dspm
