// Human-readable numbers.
#pragma once

#include <cstdint>
#include <string>

namespace dspm {

/// "678.2 MB", "12.3 KB"
std::string readable_bytes(std::size_t bytes);
/// Seconds: "4.2s", "3m12s", "2h05m".
std::string readable_time(double seconds);
/// "2%", "0.35%", "12.3%"
std::string readable_share(double share);
/// "1 frame", "25 frames"
std::string counted(std::size_t count, const char* word);
/// "12,345,678"
std::string grouped(std::uint64_t count);

}  // namespace dspm
