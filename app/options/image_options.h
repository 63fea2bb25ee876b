// The options that say how images and their layers are kept in files.
#pragma once

#include <CLI/CLI.hpp>

#include "dspm/app/options/options.h"

namespace dspm {

void add_image_options(CLI::App& app, Options& options);

}  // namespace dspm
