// A digest of each element of a scene: equal if the same is rendered, whatever the text looks like.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/lang/description.h"
#include "dspm/params/params.h"

namespace dspm {

struct ScenePartDigest {
  std::string name;  // `material "glass"`; not unique
  std::uint64_t digest;
  SourceLocation where;
};

/// Everything except what the driver reads: film, filter, sampler, integrator and accelerator. Files that the text
/// names count here by their names.
std::vector<ScenePartDigest> digests_of(const SceneDescription& scene);

/// Of a directive's type and parameters, except the parameters named in `without`.
std::uint64_t digest_of(const std::string& type, const ParamList& params, const std::vector<std::string>& without = {});

}  // namespace dspm
