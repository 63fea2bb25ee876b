// Applies AxisExclude and AxisOnly to the axes' combinations.
#pragma once

#include <vector>

#include "dspm/lang/description.h"
#include "dspm/lang/glob.h"

namespace dspm {

class CombinationRules {
 public:
  CombinationRules(const std::vector<VariationAxis>& axes, const std::vector<CombinationRule>& rules) {
    for (const CombinationRule& rule : rules) {
      known_.push_back(learn(axes, rule));
      has_only_ |= !rule.excludes;
    }
  }

  /// Returns whether the first axes' choices may be part of a combination that is left: AxisExclude leaves out what it
  /// matches, AxisOnly what neither it nor another AxisOnly matches.
  bool may_go_on(const std::vector<int>& choices) const {
    bool is_kept = !has_only_;
    for (const Known& rule : known_) {
      unsigned matched = 0;
      for (std::size_t a = 0; a < choices.size(); ++a) matched |= rule.matched[a][static_cast<std::size_t>(choices[a])];
      if (rule.excludes && matched == rule.all) return false;
      is_kept |= !rule.excludes && (matched | rule.later[choices.size()]) == rule.all;
    }
    return is_kept;
  }

 private:
  struct Known {
    bool excludes = false;
    unsigned all = 0;                            // a bit for each pattern
    std::vector<std::vector<unsigned>> matched;  // by axis and variation: patterns
    std::vector<unsigned> later;                 // by axis: what it and the axes after it can match
  };

  static Known learn(const std::vector<VariationAxis>& axes, const CombinationRule& rule) {
    Known known{rule.excludes, (1u << rule.patterns.size()) - 1, {}, std::vector<unsigned>(axes.size() + 1)};
    for (const VariationAxis& axis : axes) known.matched.emplace_back(axis.variations.size());
    for (std::size_t p = 0; p < rule.patterns.size(); ++p) {
      const Glob glob(rule.patterns[p].text);
      for (std::size_t a = 0; a < axes.size(); ++a)
        for (std::size_t v = 0; v < axes[a].variations.size(); ++v)
          if ((rule.patterns[p].axis < 0 || rule.patterns[p].axis == static_cast<int>(a)) &&
              glob.matches(axes[a].variations[v].name))
            known.matched[a][v] |= 1u << p;
    }
    for (std::size_t a = axes.size(); a-- > 0;) {
      known.later[a] = known.later[a + 1];
      for (const unsigned each : known.matched[a]) known.later[a] |= each;
    }
    return known;
  }

  std::vector<Known> known_;
  bool has_only_ = false;
};

}  // namespace dspm
