// The product's variations: all combinations of the axes' variations, or those that patterns choose.
#pragma once

#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/params/errors.h"

namespace dspm {

/// More, or more frames of all of them, are taken for a mistake unless they are chosen by name.
inline constexpr int kMostCombinations = 10'000;

/// The combinations whose names match one of `patterns` (with * and ?), in the order of the text, the last axis
/// fastest; up to `most` of them. The time it takes grows with what is found, not with what there is.
std::vector<Combination> matching_combinations(const std::vector<VariationAxis>& axes,
                                               const std::vector<std::string>& patterns, std::size_t most);

/// What the scene's frames are. All combinations where they are few enough, else those that `patterns` choose: sampling
/// must not depend on what is chosen as long as that can be had. Two of the same name are an error, as are too many.
FileFrames frames_of(const SceneDescription& scene, const std::vector<std::string>& patterns, Diagnostics& diagnostics);

}  // namespace dspm
