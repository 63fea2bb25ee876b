// The library's compressions of EXR files and ours.
#pragma once

#include <ImfCompression.h>

#include "dspm/image/exr.h"

namespace dspm {

Imf::Compression imf_compression(ExrCompression compression);
/// Those that we do not write become the usual one.
ExrCompression exr_compression(Imf::Compression compression);

}  // namespace dspm
