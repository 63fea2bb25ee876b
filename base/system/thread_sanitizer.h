// Suppressions for the thread sanitizer. Every program defines them in its own executable: the sanitizer's own
// definition would come before that of a library.
#pragma once

namespace dspm {

/// Suppresses TBB's own use of malloc and memcpy, and its delete[], which the first rule does not reach.
inline constexpr const char* kNotJudged = "called_from_lib:libtbb.so\nrace:^operator delete[]\n";

}  // namespace dspm
