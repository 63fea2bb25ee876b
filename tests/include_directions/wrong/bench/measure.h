#include "dspm/app/options.h"
#include "dspm/film/film.h"
