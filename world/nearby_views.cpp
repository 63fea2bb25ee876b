#include "dspm/world/nearby_views.h"

#include <map>
#include <utility>

#include "dspm/world/cameras.h"
#include "dspm/world/objects/nearby_changes.h"

namespace dspm {
namespace {

/// The views of a scene's frames; those of one moment and camera are made once.
class Views {
 public:
  Views(const SceneDescription& description, const CameraContext& film) : description_(description), film_(film) {}

  NearbyMoments::Views of(FileFrame frame) {
    const Moment moment = description_.frames.moment(frame);
    return {at(frame, moment), at(frame, moment_of(moment, Nearby::later)),
            at(frame, moment_of(moment, Nearby::earlier))};
  }

 private:
  View at(FileFrame frame, Moment moment) {
    const CameraUse& use = camera_use(description_, frame);
    if (!use.params.is_keyed() && !use.camera_from_world.is_keyed()) moment = Moment();
    const auto known = views_.find({&use, moment});
    if (known != views_.end()) return known->second;
    const View view(camera_at(description_, frame, moment, film_), use.camera_from_world.at(moment), film_.width,
                    film_.height);
    return views_.emplace(std::pair(&use, moment), view).first->second;
  }

  const SceneDescription& description_;
  const CameraContext film_;
  std::map<std::pair<const CameraUse*, Moment>, View> views_;
};

}  // namespace

std::vector<NearbyMoments::Views> nearby_views(const SceneDescription& description, std::span<const FileFrame> frames,
                                               const CameraContext& film) {
  Views views(description, film);
  std::vector<NearbyMoments::Views> by_frame;
  for (const FileFrame frame : frames) by_frame.push_back(views.of(frame));
  return by_frame;
}

}  // namespace dspm
