// Before a render: whether its files can be written. What would fail hours later is better known now.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dspm/session/messages.h"

namespace dspm {

/// Writes a little under a temporary name beside each file, and removes it. Throws WriteError.
void try_writes(const std::vector<std::filesystem::path>& files);

/// Warns where less than `bytes` are free in the directory of `file`; `what` takes them.
void warn_of_little_space(const std::filesystem::path& file, std::uint64_t bytes, const std::string& what,
                          Messages& messages);

}  // namespace dspm
