// Makes what Shape directives ask for, on many threads but in the order of the directives.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"
#include "dspm/lang/shape_run.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/shadow_catcher.h"
#include "dspm/shapes/shape_caustics.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/geometry_source.h"
#include "dspm/world/objects/param_states.h"
#include "dspm/world/objects/same_in_all_frames.h"
#include "dspm/world/objects/shape_maker.h"
#include "dspm/world/objects/variations.h"

namespace dspm {
namespace {

/// Compares everything but the parameters, among which only holes matter here.
bool are_alike(const ShapeUse& a, const ShapeUse& b) {
  return a.type == b.type && a.name == b.name && a.reverse_orientation == b.reverse_orientation &&
         a.material.index == b.material.index && a.material.name == b.material.name && a.area_light == b.area_light &&
         a.dynamic_block == b.dynamic_block && a.blurs == b.blurs && a.world_from_object == b.world_from_object &&
         a.params.find("alpha") == nullptr && b.params.find("alpha") == nullptr;
}

/// A mesh file without faces is a frame without the shape: a fluid before it flows, smoke that is gone.
template <class Source>
void leave_out_empty(const ShapeUse& use, Source& source, Diagnostics& diagnostics) {
  const auto empty = static_cast<std::size_t>(
      std::count_if(source.made.begin(), source.made.end(), [](const MadeShapes& made) { return made.empty(); }));
  const Param* const file = use.params.find("filename");
  if (empty == 0 || file == nullptr) return;
  if (!use.params.is_keyed()) return diagnostics.error(file->values_where, "the file has no faces");
  diagnostics.note(file->values_where,
                   fmt::format("{} of the {} files of this sequence have no faces: the shape is not "
                               "there in their frames",
                               empty, source.made.size()));
  std::vector<int> place;  // by state before
  Source left;
  for (std::size_t s = 0; s < source.made.size(); ++s) {
    place.push_back(source.made[s].empty() ? -1 : static_cast<int>(left.made.size()));
    if (source.made[s].empty()) continue;
    left.made.push_back(std::move(source.made[s]));
    left.params.states.push_back(std::move(source.params.states[s]));
    if (!source.keys.empty()) left.keys.push_back(source.keys[s]);
  }
  for (int& state : source.params.state_of)
    if (state >= 0) state = place[static_cast<std::size_t>(state)];
  source.made = std::move(left.made), source.keys = std::move(left.keys);
  source.params.states = std::move(left.params.states);
}

}  // namespace

/// Adds sources in the order of the directives. Hair may have a directive for each of a million strands: what is alike
/// becomes one shape, if shapes allow that.
class Geometry::Joining {
 public:
  Joining(Geometry& geometry, const std::vector<const ObjectUse*>& instances)
      : geometry_(geometry), instances_(instances) {}

  void add(std::span<const ShapeUse> uses) {
    constexpr std::size_t kAtATime = 4096;  // so many strands take a few megabytes until they are absorbed
    for (std::size_t begin = 0; begin < uses.size(); begin += kAtATime)
      add_some(uses.subspan(begin, std::min(kAtATime, uses.size() - begin)));
  }
  void finish() {
    if (open_) geometry_.add_source(*first_, instances_, *open_);
    open_.reset();
  }

 private:
  void add_some(std::span<const ShapeUse> uses) {
    std::vector<std::optional<Source>> sources(uses.size());
    std::vector<Diagnostics> messages(uses.size(), Diagnostics(geometry_.diagnostics_.lenient()));
    parallel_for(static_cast<std::int64_t>(uses.size()), 1, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      sources[at] = geometry_.make_source(uses[at], messages[at]);
    });
    for (std::size_t i = 0; i < uses.size(); ++i) {
      geometry_.diagnostics_.append(std::move(messages[i]));
      if (sources[i]) join(uses[i], *std::move(sources[i]));
      if (uses[i].run != nullptr) add_run(uses[i]);
    }
  }

  void join(const ShapeUse& use, Source source) {
    if (open_ && are_alike(*first_, use) && open_->absorb(source)) return;
    finish();
    first_ = &use, open_ = std::move(source);
  }

  /// Adds a run. Shapes that cannot be absorbed, or that have messages, become directives of their own.
  void add_run(const ShapeUse& first) {
    constexpr std::size_t kTogether = 256, kAtATime = 64 * kTogether;
    const std::size_t count = first.run->count();
    for (std::size_t begin = 0; begin < count; begin += kAtATime) {
      const auto part = [&](std::size_t k) { return std::min(begin + k * kTogether, count); };
      const std::size_t parts = (std::min(kAtATime, count - begin) + kTogether - 1) / kTogether;
      std::vector<std::optional<Source>> sources(parts);
      if (open_ && are_alike(*first_, first))
        parallel_for(static_cast<std::int64_t>(sources.size()), 1, [&](std::int64_t i) {
          const auto k = static_cast<std::size_t>(i);
          sources[k] = geometry_.make_source(first, part(k), part(k + 1));
        });
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (sources[k] && open_->absorb(*sources[k])) continue;
        std::vector<ShapeUse>& apart = geometry_.told_apart_.emplace_back();
        for (std::size_t i = part(k); i < part(k + 1); ++i) apart.push_back(first.run->at(i, first));
        add(apart);
      }
    }
  }

  Geometry& geometry_;
  const std::vector<const ObjectUse*>& instances_;
  const ShapeUse* first_ = nullptr;
  std::optional<Source> open_;  // of `first_`, and of what it has absorbed since
};

void Geometry::add_sources(const std::vector<ShapeUse>& uses, const std::vector<const ObjectUse*>& instances) {
  Joining joining(*this, instances);
  joining.add(uses);
  joining.finish();
}

ShapeMaker Geometry::maker_of(const ShapeUse& use) const {
  return {*shape_plugins().find(use.type), use, description_, kept_};
}

/// Makes one shape of a part of the run of `first`, which is there and has one state. Returns nullopt if there is none,
/// or if there is anything to report about it.
std::optional<Geometry::Source> Geometry::make_source(const ShapeUse& first, std::size_t begin, std::size_t end) const {
  const ShapeMaker maker = maker_of(first);
  ParamList params = first.params;
  std::optional<Source> joined;
  for (std::size_t i = begin; i < end; ++i) {
    first.run->set_numbers(i, params);
    Diagnostics messages(diagnostics_.lenient());
    MadeOfParams made = maker.make(params, messages);
    if (!messages.all().empty()) return std::nullopt;
    Source source;
    source.caustics = made.caustics, source.is_catcher = made.is_catcher;
    source.made.push_back(std::move(made.shapes));
    if (made.key) source.keys.push_back(*made.key);
    if (!joined)
      joined = std::move(source);
    else if (!joined->absorb(source))
      return std::nullopt;
  }
  return joined;
}

/// The shapes that the directive makes in all of its states; nullopt if there are none. Messages end with the first
/// state that has errors.
std::optional<Geometry::Source> Geometry::make_source(const ShapeUse& use, Diagnostics& diagnostics,
                                                      bool by_extent) const {
  if (shape_plugins().find(use.type, use.type_where, diagnostics) == nullptr) return std::nullopt;
  Source source;
  source.params =
      param_states(without_alpha(use.params), frames_of(use.blurs), presence(description_, use.dynamic_block));
  expect_same_in_all_frames(use, kShapeCausticsParam, diagnostics);
  for (const char* const name : {kShadowCatcherParam, kBetweenParam, kVelocityScaleParam})
    expect_same_in_all_frames(use, name, diagnostics);
  if (by_extent) take_extent(use, source, diagnostics);
  if (source.has_extent) return source;
  const std::vector<ShapeState>& states = source.params.states;
  std::vector<Diagnostics> messages(states.size(), Diagnostics(diagnostics.lenient()));
  std::vector<MadeOfParams> made(states.size());
  const ShapeMaker maker = maker_of(use);
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
    source.has_velocities = source.has_velocities || made[at].has_velocities;
    if (!source.unlike) source.unlike = std::move(made[at].unlike);
    is_kept = is_kept && made[at].key;
    if (made[at].key) source.keys.push_back(*made[at].key);
  }
  if (!is_kept) source.keys.clear();
  if (diagnostics.error_count() == 0) leave_out_empty(use, source, diagnostics);
  return source.made.empty() || diagnostics.error_count() > 0 ? std::nullopt : std::optional(std::move(source));
}

}  // namespace dspm
