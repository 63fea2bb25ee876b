// What Shape directives make: by many threads, and in the order of the directives.
#include <algorithm>
#include <utility>

#include "dspm/params/params.h"
#include "dspm/shapes/shadow_catcher.h"
#include "dspm/shapes/shape_caustics.h"
#include "dspm/system/parallel.h"
#include "dspm/world/geometry.h"
#include "dspm/world/geometry_source.h"
#include "dspm/world/param_states.h"
#include "dspm/world/same_in_all_frames.h"
#include "dspm/world/shape_maker.h"
#include "dspm/world/variations.h"

namespace dspm {
namespace {

/// But for their parameters, among which only holes matter here.
bool are_alike(const ShapeUse& a, const ShapeUse& b) {
  return a.type == b.type && a.name == b.name && a.reverse_orientation == b.reverse_orientation &&
         a.material.index == b.material.index && a.material.name == b.material.name && a.area_light == b.area_light &&
         a.dynamic_block == b.dynamic_block && a.world_from_object == b.world_from_object &&
         a.params.find("alpha") == nullptr && b.params.find("alpha") == nullptr;
}

}  // namespace

/// Hair may have a directive for each of a million strands: what is alike becomes one shape, where shapes allow that.
void Geometry::add_sources(const std::vector<ShapeUse>& uses, const std::vector<const ObjectUse*>& instances) {
  constexpr std::size_t kAtATime = 4096;  // so many strands take a few megabytes until they are absorbed
  const ShapeUse* first = nullptr;
  std::optional<Source> open;  // of `first`, and of what it has absorbed since
  for (std::size_t begin = 0; begin < uses.size(); begin += kAtATime) {
    const std::size_t count = std::min(kAtATime, uses.size() - begin);
    std::vector<std::optional<Source>> sources(count);
    std::vector<Diagnostics> messages(count, Diagnostics(diagnostics_.lenient()));
    parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      sources[at] = make_source(uses[begin + at], messages[at]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const ShapeUse& use = uses[begin + i];
      diagnostics_.append(std::move(messages[i]));
      if (!sources[i] || (open && are_alike(*first, use) && open->absorb(*sources[i]))) continue;
      if (open) add_source(*first, instances, *open);
      first = &use, open = std::move(sources[i]);
    }
  }
  if (open) add_source(*first, instances, *open);
}

/// The shapes that the directive makes in all of its states; nullopt if there are none. Messages end with the first
/// state that has errors.
std::optional<Geometry::Source> Geometry::make_source(const ShapeUse& use, Diagnostics& diagnostics) const {
  const auto* plugin = shape_plugins().find(use.type, use.type_where, diagnostics);
  if (!plugin) return std::nullopt;
  Source source;
  source.params =
      param_states(without_alpha(use.params), description_.frames, presence(description_, use.dynamic_block));
  expect_same_in_all_frames(use, kShapeCausticsParam, diagnostics);
  expect_same_in_all_frames(use, kShadowCatcherParam, diagnostics);
  const std::vector<ParamList>& states = source.params.states;
  std::vector<Diagnostics> messages(states.size(), Diagnostics(diagnostics.lenient()));
  std::vector<MadeOfParams> made(states.size());
  const ShapeMaker maker(*plugin, use, description_.main_directory(), kept_);
  parallel_for(static_cast<std::int64_t>(states.size()), 1, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    made[at] = maker.make(states[at], messages[at]);
  });
  // The same in all states:
  source.caustics = !made.empty() && made.front().caustics;
  source.is_catcher = !made.empty() && made.front().is_catcher;
  bool is_kept = kept_ != nullptr;
  for (std::size_t at = 0; at < states.size() && diagnostics.error_count() == 0; ++at) {
    diagnostics.append(std::move(messages[at]));
    source.made.push_back(std::move(made[at].shapes));
    is_kept = is_kept && made[at].key;
    if (made[at].key) source.keys.push_back(*made[at].key);
  }
  if (!is_kept) source.keys.clear();
  return source.made.empty() || diagnostics.error_count() > 0 ? std::nullopt : std::optional(std::move(source));
}

}  // namespace dspm
