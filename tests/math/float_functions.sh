#!/usr/bin/env bash
# dspm calls no function of floats whose last bit a C library may choose: base/math/rounded.h has its own.
# usage: float_functions.sh <library or program>...
set -euo pipefail
# CGAL 6's objects call log10f; dspm's own do not.
differ='(a?(sin|cos|tan)h?|atan2|sincos|exp|exp2|expm1|log|log2|log1p|pow|cbrt|hypot|erf|erfc|lgamma|tgamma)f'
imported=$(nm -D --undefined-only "$@" | awk '{ sub(/@.*/, "", $2); print $2 }')
[[ $imported == *nextafterf* ]] || { echo "no function of floats at all is called: is nm of use here?" >&2; exit 1; }
if called=$(grep -xE "$differ" <<<"$imported"); then
  echo "use base/math/rounded.h instead of" $called >&2
  exit 1
fi
