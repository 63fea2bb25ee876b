// Turns what a list of parameters says into a key.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/world/objects/content_key.h"

namespace dspm {

/// Lists of the same values have the same key, unless a name among them now means another file.
void add(ContentKey& key, const ParamList& params);

}  // namespace dspm
