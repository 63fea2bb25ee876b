// Nothing to complain about.
#pragma once

#include "core/vec.h"
#include "shapes/shape.h"
