// The product's variations: all combinations of the axes' variations, or those that patterns choose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"

namespace dspm {

/// More than this, or more than kMostFrames frames in all, must be chosen by name: they are taken for a mistake.
inline constexpr int kMostCombinations = 10'000;

/// Returns the combinations whose names match one of `patterns` (with * and ?), in the order of the text, the last axis
/// fastest; at most `most` of them, and none that the rules leave out. The time grows with the number found, not with
/// the number in all.
std::vector<Combination> matching_combinations(const std::vector<VariationAxis>& axes,
                                               const std::vector<std::string>& patterns, std::size_t most,
                                               const std::vector<CombinationRule>& rules = {});

/// Returns the scene's frames: all combinations if they are few enough, else those that `patterns` choose. Sampling
/// must not depend on the choice as long as that is possible. Two combinations of the same name are an error, as are
/// too many. Those that are `known` and still there keep their order; it is an error if none of them is in the base.
FileFrames frames_of(const SceneDescription& scene, const std::vector<std::string>& patterns,
                     const std::optional<KnownFrames>& known, Diagnostics& diagnostics);

}  // namespace dspm
