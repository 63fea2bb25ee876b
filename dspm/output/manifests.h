// Which id in a file stands for which name.
#pragma once

#include <vector>

#include "dspm/image/exr.h"
#include "dspm/output/output_layer.h"

namespace dspm {

/// What the header of a file with these layers says of their ids: for each name that the image shows, its id, in
/// hexadecimal digits. Of a Cryptomatte in the attributes that its specification asks for.
void add_manifests(const std::vector<const OutputLayer*>& layers, ExrHeader& header);

}  // namespace dspm
