// Whether the files of a render can be written: found out before it starts, not hours later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dspm/session/messages.h"

namespace dspm {

/// Writes a little under a temporary name beside each file, and removes it. Throws WriteError.
void try_writes(const std::vector<std::filesystem::path>& files);

/// Warns if less than `bytes` are free in the directory of `file`; `what` takes them.
void warn_of_little_space(const std::filesystem::path& file, std::uint64_t bytes, const std::string& what,
                          Messages& messages);

}  // namespace dspm
