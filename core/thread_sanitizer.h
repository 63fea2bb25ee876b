// What the thread sanitizer is not to judge. Every program says so in its own executable: in a library, the sanitizer's
// own answer comes first.
#pragma once

namespace dspm {

/// What TBB itself does by way of malloc and memcpy, and its delete[], which the first rule does not reach.
inline constexpr const char* kNotJudged = "called_from_lib:libtbb.so\nrace:^operator delete[]\n";

}  // namespace dspm
