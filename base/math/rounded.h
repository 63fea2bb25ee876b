// Functions of floats as doubles give them, rounded: the same bits with every C library. A library's own for floats may
// change with its version (glibc's did with 2.41, in 4% to 16% of arguments); those for doubles did not, and if one does,
// in its last bit, one result in hundreds of millions changes. std's exp, log, pow, sin and cos of floats are made in this
// way, in every glibc since 2.28.
#pragma once

#include <cmath>

namespace dspm::rounded {

inline float acos(float x) { return static_cast<float>(std::acos(double{x})); }
inline float asin(float x) { return static_cast<float>(std::asin(double{x})); }
inline float atan(float x) { return static_cast<float>(std::atan(double{x})); }
inline float atan2(float y, float x) { return static_cast<float>(std::atan2(double{y}, double{x})); }
inline float cbrt(float x) { return static_cast<float>(std::cbrt(double{x})); }
inline float log1p(float x) { return static_cast<float>(std::log1p(double{x})); }
inline float tan(float x) { return static_cast<float>(std::tan(double{x})); }

}  // namespace dspm::rounded
