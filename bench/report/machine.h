// Where, when and with which build figures were measured.
#pragma once

#include <string>

namespace dspm {

/// "Intel(R) Xeon(R) ..., 2 cores, 24 GB of memory, Debian GNU/Linux 12, g++ 12.2.0, optimised build"
std::string machine_and_build_in_words();

/// "2026-01-31, commit 1a2b3c4": " with changes" after the commit if the sources differ from it.
std::string date_and_commit();

}  // namespace dspm
