// Every include here breaks a rule, and one is missing; the test expects each to be named.
#pragma once

#include <tbb/parallel_for.h>

#include "dspm/image/film/film.h"
#include "dspm/nowhere/lost.h"
#include "wrong.h"

namespace dspm {

// An Image in a comment is none.
Rgb colour_of(const char* of = "an Image in a text");

}  // namespace dspm
