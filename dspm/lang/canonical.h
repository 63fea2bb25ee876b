// What a scene says, part by part, as a digest each: equal where the same is rendered, whatever the text looks like.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/params/params.h"

namespace dspm {

struct ScenePartDigest {
  std::string name;  // `material "glass"`; several may have the same
  std::uint64_t digest;
  SourceLocation where;
};

/// Everything but what the driver reads: film, filter, sampler, integrator and accelerator. Files that the text names
/// count by their names here.
std::vector<ScenePartDigest> digests_of(const SceneDescription& scene);

/// Of a directive's type and parameters, without the parameters of these names.
std::uint64_t digest_of(const std::string& type, const ParamList& params, const std::vector<std::string>& without = {});

}  // namespace dspm
