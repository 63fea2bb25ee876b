#include "dspm/session/job/named_parts.h"

namespace dspm {

std::vector<NamedPart> parts_of(const Job& job, FileFrame frame) {
  std::vector<NamedPart> parts;
  const SceneDescription& scene = *job.description;
  if (!scene.axes.empty()) parts.push_back({"variation", job.variation(frame)});
  for (std::size_t a = 0; a < scene.axes.size(); ++a)
    if (!scene.axes[a].name.empty())
      parts.push_back(
          {scene.axes[a].name, scene.axes[a].variations[static_cast<std::size_t>(scene.frames.choice(frame, a))].name});
  return parts;
}

}  // namespace dspm
