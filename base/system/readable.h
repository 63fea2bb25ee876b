// Human-readable numbers.
#pragma once

#include <cstdint>
#include <string>

namespace dspm {

/// Returns "678.2 MB", "12.3 KB" and the like.
std::string readable_bytes(std::size_t bytes);
/// Returns "4.2s", "3m12s", "2h05m" and the like, for seconds.
std::string readable_time(double seconds);
/// Returns "2%", "0.35%", "12.3%" and the like.
std::string readable_share(double share);
/// Returns "1 frame", "25 frames" and the like.
std::string counted(std::size_t count, const char* word);
/// Returns "12,345,678" and the like.
std::string grouped(std::uint64_t count);

}  // namespace dspm
