// Records which id in a file stands for which name.
#pragma once

#include <vector>

#include "dspm/image/exr.h"
#include "dspm/output/output_layer.h"

namespace dspm {

/// Adds to the header of a file with these layers what it must say of their ids: the id, in hexadecimal digits, of each
/// name that the image shows. For a Cryptomatte it goes into the attributes that its specification asks for.
void add_manifests(const std::vector<const OutputLayer*>& layers, ExrHeader& header);

}  // namespace dspm
