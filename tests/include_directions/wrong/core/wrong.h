// Every include here breaks a rule; the test expects each to be named.
#pragma once

#include <tbb/parallel_for.h>

#include "film/film.h"
#include "wrong.h"
