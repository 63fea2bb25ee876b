#!/usr/bin/env bash
# What an author of plugins does, from an installed dspm: installs it into a scratch prefix, then builds and renders with
# it. usage: installed.sh <source directory> <build directory> headers|examples|projects|moved <compiler>
set -euo pipefail
source_dir=$1 build_dir=$2 task=$3 compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
cmake --install "$build_dir" --prefix "$prefix" >/dev/null
include=$(find "$prefix" -type d -path '*/include/dspm')
dspm=$prefix/bin/dspm

fail() {
  echo "$1" >&2
  exit 1
}

build() {  # folder: configures, builds and tests it
  cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >"$work/log" 2>&1 &&
    cmake --build "$1/build" >>"$work/log" 2>&1 && ctest --test-dir "$1/build" --output-on-failure >>"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "$1 does not build, or fails its tests, with $compiler"; }
}

# Stable headers include no others of dspm.
stable_headers() {
  local stable header included
  stable=$(sed -n '/^set(public_headers/,/^set(toolkit_headers/p' "$source_dir/cmake/public_headers.cmake" |
    grep -oE '[a-z_]+/[a-z0-9_]+\.h')
  for header in $stable; do
    for included in $(grep -oE '^#include [<"]dspm/[^>"]+' "$include/$header" | sed 's|.*dspm/||'); do
      [[ $included == modules/interface.h || " "$stable" " == *[[:space:]]"$included"[[:space:]]* ]] ||
        fail "$header is stable and includes $included, which is not"
    done
  done
}

# Every header stands alone, and shows no library's types.
headers() {
  local forbidden='#include *[<"](oneapi|tbb|embree|OpenEXR|Imath|Imf|CGAL|fmt|CLI)'
  if grep -rnE "$forbidden" "$include"; then fail "the header of a library is in a public one"; fi
  local flags="-x c++ -std=c++20 -msse4.2 -mpopcnt -Wall -Wextra -Werror -fsyntax-only -I $(dirname "$include")"
  find "$include" -name '*.h' -printf '%P\n' >"$work/headers"
  xargs -P "$(nproc)" -I {} sh -c "echo '#include <dspm/{}>' | $compiler $flags -" <"$work/headers" ||
    fail "a header does not compile alone"
  stable_headers
  (($(wc -l <"$work/headers") > 40)) || fail "too few headers are installed"
}

examples() {
  local example image
  for example in ambient lighttracer velvet roundbox; do
    cp -r "$source_dir/examples/$example" "$work/"
    build "$work/$example"
    image=$(find "$work/$example/build" -name "$example*.png" | head -n 1)
    [[ -s $image ]] || fail "$example has rendered nothing"
  done
}

projects() {
  local kind commands
  export CXX=$compiler CXXFLAGS="-Wall -Wextra -Werror" CMAKE_GENERATOR=Ninja CMAKE_BUILD_TYPE=Release
  for kind in integrator material shape texture light area-light camera filter accelerator; do
    commands=$("$dspm" --new-plugin "$kind" "my_${kind//-/_}" "$work/what's new/$kind")
    bash -ec "$commands" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "what --new-plugin $kind says fails with $compiler"; }
  done
}

# dspm's own plugins, one of each kind, with nothing changed but where they are registered, give the same images.
moved() {
  local folder=$work/moved files="materials/dielectric.cpp shapes/sphere.cpp textures/checkerboard.cpp lights/spot.cpp
    cameras/perspective.cpp accel/brute_force.cpp integrators/dsppm/dsppm.cpp integrators/dsppm/hj09.cpp
    integrators/dsppm/kz11.cpp" file
  for file in $files integrators/dsppm/dsppm.h integrators/dsppm/four_frames.h accel/brute_force.h; do
    mkdir -p "$folder/dspm/$(dirname "$file")"
    cp "$source_dir/dspm/$file" "$folder/dspm/$file"
  done
  cp "$source_dir/tests/modules/moved/"* "$folder/"
  build "$folder"
}

"$task"
