#!/usr/bin/env bash
# What a GPU shares with the CPU compiles for GPUs, with no function left to be linked: as CUDA and HIP by clang, which needs
# no SDK for it, and by nvcc where it is. Each NAME.cu here has a kernel NAME that calls some of it. No operation may be
# contracted, so that devices round as processors do.
# usage: formulas.sh <source directory> <folder with dspm/... headers>; exit 77 if there is neither compiler
set -euo pipefail
folder=$1/tests/device include=$2
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# the kernel, what it is compiled by, then the command, which leaves assembly in $out/code
compile() {
  local kernel=$1 what=$2
  shift 2
  "$@" -std=c++20 -I"$include" -o "$out/code" "$folder/$kernel.cu"
  echo "$kernel for $what: $(grep -cE '^[[:space:]]+[a-z@]' "$out/code") lines of code"
}
fail() {
  echo "$@" >&2
  exit 1
}
refuse() {  # what is wrong, and how lines look that have it
  if grep -nE "$2" "$out/code" | head -5 | grep .; then fail "$1"; fi
}
ptx() {
  compile "$@"
  refuse "functions that no device has" '^[[:space:]]*\.extern'
  refuse "contracted operations, or roots and quotients that are not rounded correctly" 'fma\.|(sqrt|div|rcp)\.(approx|full)'
  grep -q "\.entry $1" "$out/code" || fail "there is no kernel $1"
}
# nvcc drops what it does not know without a word.
has_bits() {
  (($(grep -cE '(popc|clz|brev|bfind|ffs)\.[a-z0-9.]*64' "$out/code") >= 2)) || fail "bits are not counted"
}

by_clang() {
  local options=(--cuda-device-only -O2 -S -ffp-contract=off -fno-math-errno)
  ptx "$1" "NVIDIA by clang" "$clang" --cuda-gpu-arch=sm_70 -nocudainc -nocudalib -Wno-unknown-cuda-version "${options[@]}"
  compile "$1" "AMD by clang" "$clang" -x hip --offload-arch=gfx90a -nogpuinc -nogpulib "${options[@]}"
  for name in $(grep -oE '[A-Za-z_.][A-Za-z0-9_.]*@(rel32|gotpcrel)' "$out/code" | sed 's/@.*//' | sort -u); do
    grep -q "^$name:" "$out/code" || fail "no device has $name"
  done
}
by_nvcc() {
  ptx "$1" "NVIDIA by nvcc" "$nvcc" --expt-relaxed-constexpr -arch=sm_75 -fmad=false -ptx
  refuse "code that nvcc has left out" '^[[:space:]]*trap;'
  if [[ $1 == formulas ]]; then has_bits; fi
}

clang=$(command -v clang++) || clang=
nvcc=$(command -v nvcc || ls /usr/local/cuda/bin/nvcc 2>/dev/null) || nvcc=
[[ -n $clang$nvcc ]] || exit 77
for source in "$folder"/*.cu; do
  kernel=$(basename "$source" .cu)
  if [[ -n $clang ]]; then by_clang "$kernel"; fi
  if [[ -n $nvcc ]]; then by_nvcc "$kernel"; fi
done
