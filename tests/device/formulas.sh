#!/usr/bin/env bash
# The formulas of formulas.cu compile for GPUs, with no function left to be linked: as CUDA and HIP by clang, which needs no
# SDK for it, and by nvcc where it is. No operation may be contracted, so that devices round as processors do.
# usage: formulas.sh <source directory> <folder with dspm/... headers>; exit 77 if there is neither compiler
set -euo pipefail
source=$1/tests/device/formulas.cu include=$2
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

tried=0
# what it is, then the command, which leaves assembly in $out/code
compile() {
  local what=$1
  shift
  "$@" -std=c++20 -I"$include" -o "$out/code" "$source"
  tried=$((tried + 1))
  echo "$what: $(grep -cE '^[[:space:]]+[a-z@]' "$out/code") lines of code"
}
refuse() {  # what is wrong, and how lines look that have it
  if grep -nE "$2" "$out/code" | head -5 | grep .; then
    echo "$1" >&2
    exit 1
  fi
}
ptx() {
  compile "$@"
  refuse "functions that no device has" '^[[:space:]]*\.extern'
  refuse "contracted operations, or roots and quotients that are not rounded correctly" 'fma\.|(sqrt|div|rcp)\.(approx|full)'
  # nvcc drops what it does not know.
  for word in '\.entry formulas' 'div\.rn\.f64' 'sqrt\.rn\.f32'; do
    grep -qE "$word" "$out/code" || { echo "there is no $word" >&2; exit 1; }
  done
  (($(grep -cE '(popc|clz|brev|bfind|ffs)\.[a-z0-9.]*64' "$out/code") >= 2)) || { echo "bits are not counted" >&2; exit 1; }
}

if clang=$(command -v clang++); then
  options=(--cuda-device-only -O2 -S -ffp-contract=off -fno-math-errno)
  ptx "NVIDIA by clang" "$clang" --cuda-gpu-arch=sm_70 -nocudainc -nocudalib -Wno-unknown-cuda-version "${options[@]}"
  compile "AMD by clang" "$clang" -x hip --offload-arch=gfx90a -nogpuinc -nogpulib "${options[@]}"
  for name in $(grep -oE '[A-Za-z_][A-Za-z0-9_]*@(rel32|gotpcrel)' "$out/code" | sed 's/@.*//' | sort -u); do
    grep -q "^$name:" "$out/code" || { echo "no device has $name" >&2; exit 1; }
  done
fi
if nvcc=$(command -v nvcc || ls /usr/local/cuda/bin/nvcc 2>/dev/null); then
  ptx "NVIDIA by nvcc" "$nvcc" --expt-relaxed-constexpr -arch=sm_75 -fmad=false -ptx
fi
((tried > 0)) || exit 77
