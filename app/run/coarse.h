// The first pictures of a live page: a few iterations of a quarter of the size, with fewer photons. They start without
// what a render learns about where photons should start, or with what the last one learned before an edit.
#pragma once

#include <memory>

#include "dspm/app/options/options.h"
#include "dspm/looking/serve/live_page.h"
#include "dspm/session/load.h"

namespace dspm {

/// Loads the scene in that size. For `kept`, see WorldOptions. Throws SceneError if it cannot be rendered.
std::unique_ptr<LoadedScene> load_coarsely(const Options& options, Messages& messages, KeptGeometry& kept);
/// Shows the pictures; ends early if `page` wants an end.
void show_coarsely(const LoadedScene& loaded, LivePage& page);

}  // namespace dspm
