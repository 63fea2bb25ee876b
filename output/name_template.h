// Names of images by a template: "{legs}_{seat}_{frame}.exr" becomes "oak_red_0001.exr".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/session/job/named_parts.h"

namespace dspm {

/// Returns whether the name has a part in braces.
bool is_template(std::string_view name);
/// Fills in the parts. {frame} has four digits, {frame:2} at least two; {{ and }} are braces. Throws UsageError if a
/// name is not among the parts.
std::string filled_in(std::string_view pattern, const std::vector<NamedPart>& parts, int frame);

/// The folders of a name that was filled in: whoever names folders after variations cannot make them all. Throws WriteError.
void make_folders_of_template(std::string_view pattern, const std::filesystem::path& filled_in);

}  // namespace dspm
