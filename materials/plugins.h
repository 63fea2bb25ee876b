// The factories of this folder's plugins, one a file.
#pragma once

#include "materials/material.h"

namespace dspm {

MakeMaterial make_coateddiffuse, make_conductor, make_dielectric, make_diffuse, make_thindielectric;

}  // namespace dspm
