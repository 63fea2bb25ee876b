// Converts between the library's compressions of EXR files and ours.
#pragma once

#include <ImfCompression.h>

#include "dspm/image/exr.h"

namespace dspm {

Imf::Compression imf_compression(ExrCompression compression);
/// Turns those that we do not write into the usual one.
ExrCompression exr_compression(Imf::Compression compression);

}  // namespace dspm
