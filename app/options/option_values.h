// The values of command line options that are more than a number or a word. All functions throw UsageError, quoting
// what was given.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dspm/app/options/options.h"
#include "dspm/base/math/moments.h"

namespace dspm {

/// Reads "1-8,12,1-32:4" (every fourth from 1 to 32); the result is ascending, without repetition.
std::vector<Moment> parse_frames(std::string_view text);
/// Reads "30s", "1h30m" or "1.5h"; a bare number is seconds.
double parse_duration(const char* option, std::string_view text);
/// Reads a duration with a unit, or a bare number of iterations.
Interval parse_interval(const char* option, std::string_view text);
/// Reads "2%" or "0.02": above 0, below 1.
double parse_share(const char* option, std::string_view text);
/// Reads "2G", "1.5GiB" or "800M" as bytes. K, M, G and T count in thousands, Ki, Mi, Gi and Ti in 1024s; a bare number
/// is bytes.
std::size_t parse_bytes(const char* option, std::string_view text);
std::array<double, 4> parse_crop_window(std::string_view text);
std::array<int, 4> parse_pixel_bounds(std::string_view text);

/// The parts of the iterations and of the frames.
struct Parts {
  Part iterations, frames;
};
/// Reads "3/8", "frames:3/8", or both: "1/2,frames:3/8".
Parts parse_parts(std::string_view text);

/// Reads "50%" or "800x600".
Resolution parse_resolution(std::string_view text);

/// Reads "N,albedo": at least one name, none empty.
std::vector<std::string> parse_names(const char* option, std::string_view text);

/// Returns options as pbrt lets them be written (one dash or two; letter case, '-' and '_' in the name do not matter)
/// in the spelling of `names`. Other arguments stay unchanged.
std::vector<std::string> canonical_spelling(const std::vector<std::string>& arguments,
                                            const std::vector<std::string>& names);

}  // namespace dspm
