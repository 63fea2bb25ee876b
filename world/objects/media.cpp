#include "dspm/world/objects/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"
#include "dspm/world/objects/in_frame.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/param_key.h"
#include "dspm/world/objects/params_at.h"
#include "dspm/world/objects/placement_check.h"

namespace dspm {
namespace {

/// What makes a medium in a frame, before its parameters are evaluated.
struct MediumSource {
  Definition::Use use;
  Moment moment;
  friend bool operator==(const MediumSource& a, const MediumSource& b) {
    return a.use.plugin == b.use.plugin && a.moment == b.moment;
  }
};

struct MediumState {
  const PluginUse* use;
  ParamList params;
  Matrix4 world_from_medium;
};

ContentKey key_of(const MediumState& state) {
  ContentKey key(state.use->type);
  dspm::add(key, state.params);
  key.add_bytes_of(state.world_from_medium);
  return key;
}

std::shared_ptr<const Medium> make(const MediumState& state, const std::filesystem::path& directory,
                                   Diagnostics& diagnostics) {
  const auto* plugin = medium_plugins().find(state.use->type, state.use->type_where, diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader reader(state.params, fmt::format("medium \"{}\"", state.use->type), state.use->where, diagnostics,
                     directory);
  return plugin->make(reader, {Transform(state.world_from_medium)});
}

std::shared_ptr<const Majorants> majorants_of(const std::vector<const Medium*>& states) {
  return std::make_shared<const Majorants>(states);
}

}  // namespace

Media::Media(const SceneDescription& description, const Media* sooner, Diagnostics& diagnostics)
    : description_(description), diagnostics_(diagnostics) {
  for (const MediumUse& use : description.media) add(use, sooner);
  for (const MediumInterfaceUse& use : description.medium_interfaces) {
    const MediumInterface found{find(use.inside, use.where), find(use.outside, use.where)};
    used_ = used_ || found.inside != kNoMedium || found.outside != kNoMedium;
    interfaces_.push_back(found);
  }
}

void Media::add(const MediumUse& own, const Media* sooner) {
  const FileFrames& frames = description_.frames;
  OfFile medium{own.name, definition_of(description_, own), {}, {}, {}};
  const auto sources = Timeline<MediumSource>::of(
      frames.count(),
      [&](FileFrame f) {
        const Definition::Use& use = medium.definition.uses[medium.definition.use_of[frames.combination_of(f)]];
        return std::optional(MediumSource{use, use.is_keyed() ? frames.moment(f) : Moment()});
      },
      [](const MediumSource& a, const MediumSource& b) { return a == b; });
  const int errors = diagnostics_.error_count();
  Timeline<MediumState> states;
  Timeline<MediumState>::Index index;
  std::vector<int> state_of;
  for (const MediumSource& source : sources.states)
    state_of.push_back(states.place(
        MediumState{source.use.plugin, params_at(source.use.plugin->params, frames, source.moment),
                    source.use.motion->at(source.moment)},
        index,
        [](const MediumState& a, const MediumState& b) {
          return a.use == b.use && a.world_from_medium == b.world_from_medium && a.params.same_values(b.params);
        },
        [](const MediumState& state) { return Likeness().add(state.world_from_medium).add(state.params).number(); }));
  for (const int source : sources.state_of)
    medium.states.state_of.push_back(state_of[static_cast<std::size_t>(source)]);
  for (FileFrame f(0); f.index() < frames.count(); ++f) {
    const MediumState& state = states.states[static_cast<std::size_t>(medium.states.at(f))];
    if (is_sound(state.world_from_medium)) continue;
    return report_singular(fmt::format("medium \"{}\"", own.name), in_frame(frames, f), state.use->where, diagnostics_);
  }
  const OfFile* const before = sooner != nullptr ? &sooner->media_[media_.size()] : nullptr;
  for (const MediumState& state : states.states) {
    const ContentKey& key = medium.keys.emplace_back(key_of(state));
    std::shared_ptr<const Medium> made;
    for (std::size_t i = 0; before != nullptr && i < before->keys.size(); ++i)
      if (before->keys[i] == key) made = before->states.states[i];
    medium.states.states.push_back(made ? made : make(state, description_.main_directory(), diagnostics_));
    if (diagnostics_.error_count() > errors) return;
  }
  // Variations that are added later leave the others' paths as they are.
  const auto base = static_cast<std::size_t>(medium.states.states_of_first(frames.base().count()));
  std::vector<const Medium*> common;
  for (std::size_t i = 0; i < base; ++i) common.push_back(medium.states.states[i].get());
  const bool same = before != nullptr && before->states.states == medium.states.states;
  const auto of_base = same ? before->majorants.front() : majorants_of(common);
  for (std::size_t i = 0; i < medium.states.states.size(); ++i) {
    const Medium& state = *medium.states.states[i];
    medium.majorants.push_back(i < base ? of_base : same ? before->majorants[i] : majorants_of({&state}));
  }
  by_name_.emplace(own.name, static_cast<int>(media_.size()));
  media_.push_back(std::move(medium));
}

int Media::find(const std::string& name, const SourceLocation& where) {
  if (name.empty()) return kNoMedium;
  if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
  std::vector<std::string> names;
  for (const MediumUse& use : description_.media) {
    if (use.name == name) return kNoMedium;  // it has errors of its own
    names.push_back(use.name);
  }
  const std::string guess = did_you_mean(name, names);
  diagnostics_.error(where, fmt::format("there is no medium named \"{}\"", name),
                     guess.empty() ? "define it with MakeNamedMedium" : guess);
  return kNoMedium;
}

MediumInterface Media::interface(int use) const {
  return use < 0 ? MediumInterface{} : interfaces_[static_cast<std::size_t>(use)];
}

std::vector<Media::Glowing> Media::glowing() const {
  std::vector<Glowing> all;
  for (std::size_t m = 0; m < media_.size(); ++m) {
    const OfFile& medium = media_[m];
    const auto is_named = [&](const MediumInterface& sides) {
      return sides.inside == static_cast<int>(m) || sides.outside == static_cast<int>(m);
    };
    if (std::ranges::any_of(medium.states.states, [](const auto& state) { return state->glows(); }) &&
        std::ranges::any_of(interfaces_, is_named))
      all.push_back(
          {static_cast<int>(m), medium.name, use_of(static_cast<int>(m), FileFrame(0)), medium.states, medium.keys});
  }
  return all;
}

std::vector<SceneMedium> Media::in(const std::vector<FileFrame>& frames) const {
  std::vector<SceneMedium> media;
  if (!used_) return media;
  for (const OfFile& medium : media_) {
    SceneMedium& cut = media.emplace_back();
    for (std::size_t s = 0; s < medium.states.states.size(); ++s) {
      const FrameSet set = frames_in_state(medium.states, static_cast<int>(s), frames);
      if (set.empty()) continue;
      cut.states.states.push_back({set, medium.states.states[s]});
      auto& groups = cut.majorants.states;
      const auto same = std::find_if(groups.begin(), groups.end(),
                                     [&](const auto& group) { return group.object == medium.majorants[s]; });
      if (same == groups.end())
        groups.push_back({set, medium.majorants[s]});
      else
        same->frames |= set;
    }
  }
  return media;
}

std::vector<std::string> Media::explain(std::span<const FileFrame> frames) const {
  std::vector<std::string> lines;
  for (const OfFile& medium : media_) {
    std::set<int> states;
    for (const FileFrame f : frames) states.insert(medium.states.at(f));
    if (used_ && states.size() > 1)
      lines.push_back(fmt::format(
          "medium \"{}\": {} states over the frames. Photons stay together if it is as dense in all of them; "
          "camera paths pass through it together, but look for photons once per state.",
          medium.name, states.size()));
  }
  return lines;
}

const PluginUse& Media::use_of(int medium, FileFrame frame) const {
  const Definition& definition = media_[static_cast<std::size_t>(medium)].definition;
  return *definition.uses[definition.use_of[description_.frames.combination_of(frame)]].plugin;
}

}  // namespace dspm
