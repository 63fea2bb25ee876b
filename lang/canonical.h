// A digest of each element of a scene: equal if it renders the same, however the text is written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"

namespace dspm {

struct ElementDigest {
  std::string name;  // `material "glass"`; not unique
  std::uint64_t digest;
  SourceLocation where;
  enum class Kind { common, look, light, block, shape, instance, object, variation };
  Kind kind = Kind::common;
  int dynamic_block = -1;         // of a block (itself), a light, a shape or an instance; -1: static
  std::string object = {};        // of an object, its shapes and instances
  int axis = -1, variation = -1;  // of a variation and what it replaces
};

/// Returns the digests of everything except the settings of the job: film, filter, sampler, integrator and accelerator.
/// Only the names of referenced files enter the digests. Of motions, and of the list of frames, only `part` matters.
std::vector<ElementDigest> digests_of(const SceneDescription& scene, const FramesPart& part);

/// Returns the digest of a directive's type and parameters, except the parameters named in `without`.
std::uint64_t digest_of(const std::string& type, const ParamList& params, const std::vector<std::string>& without = {});

}  // namespace dspm
