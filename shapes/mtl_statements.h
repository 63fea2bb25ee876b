// The statements of MTL files, as tinyobjloader expects them.
#pragma once

#include <string>
#include <string_view>

#include "dspm/shapes/mtl.h"

namespace dspm {

/// Returns the same materials in the spellings that tinyobjloader reads as the format means them: one line each,
/// keywords in their usual case, three numbers for every colour and for each -s, -o and -t, colours in XYZ as RGB, `d`
/// without -halo, names of one word. Colours that are spectra go to `left_out`, and so does -halo.
std::string for_tinyobj(const std::string& mtl, MtlLeftOut& left_out);

/// Returns the name of a material that for_tinyobj has made one word.
std::string name_from_tinyobj(std::string_view name);

}  // namespace dspm
