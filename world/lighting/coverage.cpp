#include "dspm/world/lighting/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

constexpr std::size_t kNamesListed = 5;
constexpr const char* kWayOut =
    "one choice of lights and one sphere serve all frames of a checkpoint, and those that it has must keep theirs; let "
    "--variation or --frames choose the other frames here, and these in a run of their own, without --resume";

bool is_within(const WorldShape& shape, const BoundingSphere& sphere) {
  Bounds3 box;
  for (int i = 0; i < shape.placed.shape->primitive_count(); ++i) box.add(shape.placed.bounds(i));
  return is_within(box, sphere);
}

/// Collects faults, and the frames that have them.
class Faults {
 public:
  explicit Faults(const FileFrames& frames) : frames_(frames) {}
  void add(const std::string& what, FileFrame frame) { labels_[what].push_back(frames_.label(frame)); }
  void report(Diagnostics& diagnostics) const {
    for (const auto& [what, labels] : labels_) {
      const std::size_t shown = std::min(labels.size(), kNamesListed);
      std::string list = fmt::format("{}", fmt::join(labels.begin(), labels.begin() + static_cast<long>(shown), ", "));
      if (shown < labels.size()) list += fmt::format(" and {} more", labels.size() - shown);
      diagnostics.error({}, fmt::format("{}: {}", list, what), kWayOut);
    }
  }

 private:
  const FileFrames& frames_;
  std::map<std::string, std::vector<std::string>> labels_;
};

void expect_light(const std::vector<WorldLight>& lights, const LightChoices& choices, FileFrame f, Faults& faults) {
  bool all_shone = true, any = false;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!(lights[i].power(f) > 0)) continue;
    any = true;
    if (lights[i].probability > 0) continue;
    all_shone = false;
    faults.add(
        fmt::format("the light \"{}\" shone in no frame that the checkpoint was begun with", lights[i].short_name), f);
  }
  const auto& probabilities = choices.probabilities[static_cast<std::size_t>(choices.of_frame[f.slot()])];
  if (any && all_shone && !(worth_of_choice(weights_in(lights, f), probabilities) > 0))
    faults.add("no frame that the checkpoint was begun with had all of its lights", f);
}

}  // namespace

void expect_covered(const SceneDescription& description, const std::function<bool(FileFrame)>& is_rendered,
                    const Geometry& geometry, const BoundingSphere& sphere, const std::vector<WorldLight>& lights,
                    const LightChoices& choices, Diagnostics& diagnostics) {
  const FileFrames& frames = description.frames;
  const FileFrame first(frames.base().count());
  if (first.index() == frames.count()) return;
  Faults faults(frames);
  for (FileFrame f = first; f.index() < frames.count(); ++f)
    if (is_rendered(f)) expect_light(lights, choices, f, faults);
  for (const WorldShape& shape : geometry.shapes()) {
    if (shape.nowhere || !shape.present.any(first, FileFrame(frames.count()))) continue;
    const bool is_outside = !is_within(shape, sphere), shines = shape.emitter >= 0;
    const bool is_lit = shines && geometry.emitters()[static_cast<std::size_t>(shape.emitter)].is_hidden;
    shape.present.for_each([&](FileFrame f) {
      if (f < first || !is_rendered(f)) return;
      if (is_outside) faults.add("some of it lies outside of what the checkpoint was begun with", f);
      if (is_lit) faults.add("an area light is seen that was not in the frames that the checkpoint was begun with", f);
    });
  }
  faults.report(diagnostics);
}

}  // namespace dspm
