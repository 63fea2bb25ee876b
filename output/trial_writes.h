// Finds out whether the files of a render can be written before it starts, not hours later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dspm/session/messages.h"

namespace dspm {

/// Writes a little under a temporary name beside each file, and removes it. Throws WriteError.
void try_writes(const std::vector<std::filesystem::path>& files);

/// Warns if less than the `bytes` that `what` takes are free in the directory of `file`.
void warn_of_little_space(const std::filesystem::path& file, std::uint64_t bytes, const std::string& what,
                          Messages& messages);

}  // namespace dspm
