#include "dspm/app/options.h"
#include "dspm/image/film/film.h"
