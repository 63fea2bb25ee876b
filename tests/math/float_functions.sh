#!/usr/bin/env bash
# What dspm calls has the same bits with every C library: base/math/rounded.h says which functions of floats have not.
# usage: float_functions.sh <library or program>...
set -euo pipefail
# CGAL 6's objects call log10f; dspm's own do not.
differ='(acos|asin|atan|atan2|tan|acosh|asinh|atanh|cosh|sinh|tanh|cbrt|erf|erfc|expm1|log1p|lgamma|tgamma)f'
imported=$(nm -D --undefined-only "$@" | awk '{ sub(/@.*/, "", $2); print $2 }')
[[ $imported == *sinf* ]] || { echo "no function of floats at all is called: is nm of use here?" >&2; exit 1; }
if called=$(grep -xE "$differ" <<<"$imported"); then
  echo "use base/math/rounded.h instead of" $called >&2
  exit 1
fi
