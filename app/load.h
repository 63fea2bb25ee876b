// From scene files to all that a render needs.
#pragma once

#include <memory>

#include "app/job.h"
#include "app/messages.h"
#include "world/world.h"

namespace dspm {

/// Throws SceneError with everything that is wrong with the scene; warnings and notes have been shown by then.
struct LoadedScene {
  LoadedScene(const Options& options, Messages& messages);

  std::unique_ptr<const SceneDescription> description;  // locations in messages point into it
  Job job;
  std::unique_ptr<const World> world;
};

/// `scene ok: ...`, once all has been made that a render makes.
std::string summary_of(const LoadedScene& loaded);

}  // namespace dspm
