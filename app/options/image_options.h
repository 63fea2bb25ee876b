// The options that say how images and their layers are kept in files.
#pragma once

#include <CLI/CLI.hpp>

#include "dspm/app/options/options.h"

namespace dspm {

void add_image_options(CLI::App& app, Options& options);
/// Shows optional values as they are typed: CLI11 shows them by their defaults.
void show_optional_values(std::string& help);

}  // namespace dspm
