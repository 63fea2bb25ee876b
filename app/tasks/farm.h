// The task "farm" of the command line: a render's parts and their merge, as jobs of a render farm.
#pragma once

#include <string>
#include <vector>

#include "dspm/app/options/options.h"

namespace dspm {

/// Returns the names of the kinds of farms.
std::vector<std::string> farms();
/// Returns a script or a template of the kind options.farm, for this command line.
std::string farm_job(const Options& options);

}  // namespace dspm
