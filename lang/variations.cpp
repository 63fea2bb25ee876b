#include "dspm/lang/variations.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "dspm/lang/combination_rules.h"
#include "dspm/lang/glob.h"
#include "dspm/lang/keyframe_group.h"

namespace dspm {
namespace {

/// Returns the piece that an axis's variation adds to the combination's name.
std::string part_of_name(std::size_t axis, const Variation& variation) {
  return axis == 0 ? variation.name : "-" + variation.name;
}

/// Rules may leave nothing of so many combinations that trying them would never end.
constexpr std::size_t kMostTried = 4'000'000;
struct TooManyTried {};

/// Descends the axes, choice by choice, but only as long as a pattern can still match.
class Search {
 public:
  Search(const std::vector<VariationAxis>& axes, const std::vector<CombinationRule>& rules,
         const std::vector<std::string>& patterns, std::size_t most)
      : axes_(axes), rules_(axes, rules), most_(most) {
    for (const std::string& pattern : patterns) globs_.emplace_back(pattern);
    learn_ends();
  }

  std::vector<Combination> find() {
    std::vector<Glob::State> states;
    for (const Glob& glob : globs_) states.push_back(glob.start());
    descend(states);
    return std::move(found_);
  }

 private:
  bool can_end(std::size_t axis, std::size_t glob, const Glob::State& state) const {
    for (std::size_t i = 0; i < state.size(); ++i)
      if (state[i] && ends_[axis][glob][i]) return true;
    return false;
  }

  /// Finds, from the last axis to the first, the places in a pattern from which some choices lead to its end.
  void learn_ends() {
    ends_.resize(axes_.size() + 1);
    for (const Glob& glob : globs_) {
      Glob::State& all = ends_.back().emplace_back(glob.places());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = glob.accepts(glob.at(i));
    }
    for (std::size_t axis = axes_.size(); axis-- > 0;)
      for (std::size_t g = 0; g < globs_.size(); ++g) {
        Glob::State& ends = ends_[axis].emplace_back(globs_[g].places());
        for (std::size_t i = 0; i < ends.size(); ++i)
          ends[i] = std::any_of(axes_[axis].variations.begin(), axes_[axis].variations.end(), [&](const Variation& v) {
            return can_end(axis + 1, g, globs_[g].after(globs_[g].at(i), part_of_name(axis, v)));
          });
      }
  }

  void descend(const std::vector<Glob::State>& states) {
    const std::size_t axis = path_.choices.size();
    bool goes_on = false;
    for (std::size_t g = 0; g < globs_.size(); ++g) goes_on = goes_on || can_end(axis, g, states[g]);
    if (!goes_on || found_.size() == most_ || !rules_.may_go_on(path_.choices)) return;
    if (++tried_ > kMostTried) throw TooManyTried();
    if (axis == axes_.size()) return found_.push_back(path_);
    const std::size_t length = path_.name.size();
    for (std::size_t v = 0; v < axes_[axis].variations.size(); ++v) {
      const std::string part = part_of_name(axis, axes_[axis].variations[v]);
      std::vector<Glob::State> next;
      for (std::size_t g = 0; g < globs_.size(); ++g) next.push_back(globs_[g].after(states[g], part));
      path_.name += part;
      path_.choices.push_back(static_cast<int>(v));
      descend(next);
      path_.choices.pop_back();
      path_.name.resize(length);
    }
  }

  const std::vector<VariationAxis>& axes_;
  const CombinationRules rules_;
  const std::size_t most_;
  std::size_t tried_ = 0;
  std::vector<Glob> globs_;
  std::vector<std::vector<Glob::State>> ends_;  // by axis and pattern
  Combination path_;
  std::vector<Combination> found_;
};

/// Returns "2 x 3 x 500 = 3000"; with many axes, only the product.
std::string product_in_words(const std::vector<VariationAxis>& axes) {
  double product = 1;
  std::string factors;
  for (const VariationAxis& axis : axes) {
    product *= static_cast<double>(axis.variations.size());
    factors += fmt::format("{}{}", factors.empty() ? "" : " x ", axis.variations.size());
  }
  const std::string number = product < 1e15 ? fmt::format("{:.0f}", product) : fmt::format("{:.0e}", product);
  return axes.size() > 1 && axes.size() <= 8 ? factors + " = " + number : number;
}

void refuse_equal_names(const SceneDescription& scene, const std::vector<Combination>& combinations,
                        Diagnostics& diagnostics) {
  std::map<std::string_view, const Combination*> seen;
  for (const Combination& each : combinations) {
    const auto [first, is_new] = seen.emplace(each.name, &each);
    if (is_new || diagnostics.error_count() >= kErrorsShown) continue;
    std::size_t axis = 0;  // the first in which the two differ
    while (axis + 1 < scene.axes.size() && first->second->choices[axis] == each.choices[axis]) ++axis;
    const auto choice = [&](const Combination& c) -> const Variation& {
      return scene.axes[axis].variations[static_cast<std::size_t>(c.choices[axis])];
    };
    diagnostics.error(choice(each).where, fmt::format("two variations of the product are named \"{}\"", each.name),
                      fmt::format("one has \"{}\", the other \"{}\": rename one of these", choice(*first->second).name,
                                  choice(each).name));
  }
}

FileFrames all_frames(const SceneDescription& scene, std::vector<Combination> combinations) {
  return {scene.moments, std::move(combinations), std::nullopt, scene.first_moment};
}

/// The known ones first, in their order. Some may not be there any more: the base is smaller then.
FileFrames in_known_order(const SceneDescription& scene, std::vector<Combination> combinations,
                          const KnownFrames& known, Diagnostics& diagnostics) {
  std::map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < combinations.size(); ++i) places.emplace(combinations[i].name, i);
  std::vector<Combination> ordered;
  std::vector<bool> taken(combinations.size());
  FramesPart base{known.base.moments, 0};
  for (std::size_t i = 0; i < known.names.size(); ++i) {
    const auto found = places.find(known.names[i]);
    if (found == places.end()) continue;
    if (i < static_cast<std::size_t>(known.base.combinations)) ++base.combinations;
    taken[found->second] = true;
    ordered.push_back(combinations[found->second]);
  }
  for (std::size_t i = 0; i < combinations.size(); ++i)
    if (!taken[i]) ordered.push_back(std::move(combinations[i]));
  if (base.combinations == 0) {
    diagnostics.error({},
                      known.names.front().empty() ? "the checkpoint is of this scene without variations"
                                                  : "no variation that the checkpoint was begun with is there any more",
                      "variations can be added to a render, and some may be taken away; to start over, use another "
                      "checkpoint");
    return all_frames(scene, std::move(ordered));
  }
  return {scene.moments, std::move(ordered), base, scene.first_moment};
}

}  // namespace

std::vector<Combination> matching_combinations(const std::vector<VariationAxis>& axes,
                                               const std::vector<std::string>& patterns, std::size_t most,
                                               const std::vector<CombinationRule>& rules) {
  return Search(axes, rules, patterns, most).find();
}

FileFrames frames_of(const SceneDescription& scene, const std::vector<std::string>& patterns,
                     const std::optional<KnownFrames>& known, Diagnostics& diagnostics) try {
  const int most = std::clamp(kMostFrames / scene.moments, 1, kMostCombinations);
  const std::size_t one_more = static_cast<std::size_t>(most) + 1;
  const auto matching = [&](std::vector<std::string> names) {
    if (known && names.front() != "*") names.insert(names.end(), known->names.begin(), known->names.end());
    return matching_combinations(scene.axes, names, one_more, scene.rules);
  };
  std::vector<Combination> combinations = matching({"*"});
  const auto too_many = [&] { return combinations.size() == one_more; };
  if (combinations.empty() && diagnostics.error_count() == 0)
    diagnostics.error(scene.rules.front().where, "AxisExclude and AxisOnly leave no variation");
  if (too_many() && !patterns.empty()) combinations = matching(patterns);
  if (too_many()) {
    const std::string product = product_in_words(scene.axes),
                      limit = fmt::format("more than {}{}", most,
                                          most == kMostCombinations ? "" : fmt::format(" of {} frames", scene.moments));
    diagnostics.error(scene.axes.front().where,
                      patterns.empty() ? fmt::format("the axes make {} variations, {}", product, limit)
                                       : fmt::format("--variation chooses {} of the {} variations", limit, product),
                      "choose some by name: --variation 'oak-*'");
    combinations.clear();
  }
  if (diagnostics.error_count() == 0) refuse_equal_names(scene, combinations, diagnostics);
  if (!known || diagnostics.error_count() > 0) return all_frames(scene, std::move(combinations));
  if (scene.moments < known->moments)
    diagnostics.error(scene.frames_where, fmt::format("the checkpoint has {} frames", known->moments),
                      "frames can be added to a render, but not taken away");
  if (diagnostics.error_count() > 0) return all_frames(scene, std::move(combinations));
  return in_known_order(scene, std::move(combinations), *known, diagnostics);
} catch (const TooManyTried&) {
  diagnostics.error(scene.rules.front().where,
                    fmt::format("AxisExclude and AxisOnly leave too few: {} combinations were tried", kMostTried),
                    "put the axes that they name first");
  return all_frames(scene, {});
}

}  // namespace dspm
