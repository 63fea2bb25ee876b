// What --version prints.
#pragma once

#include <string>

namespace dspm {

/// Returns the compiler and the kind of build: "g++ 12.2.0, Release".
std::string build_in_words();
/// Returns "dspm 0.3.0" and, in lines of their own, how it was built, and which optional parts it has and lacks.
std::string version_text();

}  // namespace dspm
