#!/usr/bin/env bash
# What an author of plugins does, from an installed dspm: installs it into a scratch prefix, then builds and renders with
# it. usage: [warnings=-Werror] installed.sh <source directory> <build directory> headers|examples|projects|moved <compiler>
set -euo pipefail
export warnings=${warnings:--Wall -Wextra}
source_dir=$1 build_dir=$2 task=$3 compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix
cmake --install "$build_dir" --prefix "$prefix" >/dev/null
include=$(find "$prefix" -type d -path '*/include/dspm')
dspm=$prefix/bin/dspm
flags="-x c++ $(sed -n 's/^Cflags: -I[^ ]*//p' "$(find "$prefix" -name dspm.pc)") $warnings -I $(dirname "$include")"

fail() {
  echo "$1" >&2
  exit 1
}

build() {  # folder: configures, builds and tests it
  cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="$warnings" >"$1.log" 2>&1 &&
    cmake --build "$1/build" >>"$1.log" 2>&1 && ctest --test-dir "$1/build" --output-on-failure >>"$1.log" 2>&1 ||
    { cat "$1.log" >&2; fail "$1 does not build, or fails its tests, with $compiler"; }
}

# Stable headers include no others of dspm.
stable_headers() {
  local stable header included
  stable=$(sed -n '/^set(public_headers/,/^set(toolkit_headers/p' "$source_dir/cmake/public_headers.cmake" |
    grep -oE '[a-z_/]+/[a-z0-9_]+\.h')
  for header in $stable; do
    for included in $(grep -oE '^#include [<"]dspm/[^>"]+' "$include/$header" | sed 's|.*dspm/||'); do
      [[ $included == session/modules/interface.h || " "$stable" " == *[[:space:]]"$included"[[:space:]]* ]] ||
        fail "$header is stable and includes $included, which is not"
    done
  done
}

# A header's path of before the rooms had wings still works, and the compiler says what to write.
old_paths() {
  local said
  said=$(echo '#include <dspm/math/vec.h>' | $compiler $flags -fsyntax-only - 2>&1) ||
    fail "<dspm/math/vec.h> no longer works: $said"
  [[ $said == *'write <dspm/base/math/vec.h>'* ]] || fail "of <dspm/math/vec.h> the compiler says: $said"
  grep -rlq '^#include <dspm/integrators/photons/gather.h>' "$include/integrators" ||
    fail "there is no <dspm/integrators/gather.h>"
}

# Those that the build has not compiled alone, as the first line of a source file of their name: all, if it has compiled
# sources together.
not_yet_compiled() {
  local header source
  while read -r header; do
    source=$source_dir/${header%.h}.cpp
    [[ ! ${compiled_together:-} && -f $source && $(grep -m 1 '^#include' "$source") == "#include \"dspm/$header\"" ]] || echo "$header"
  done <"$work/headers"
}

# One in five, other ones for other sources; all of them if DSPM_SEEDS is set (./dev soak): each costs a second.
some_of_them() {
  local parts=5 part
  [[ ! ${DSPM_SEEDS:-} ]] || parts=1
  part=$(cd "$include" && cat $(cat "$work/headers") | cksum | cut -d ' ' -f 1)
  awk -v parts=$parts -v part=$((part % parts)) 'NR % parts == part'
}

# Every header stands alone, with what is installed, and shows no library's types.
headers() {
  local forbidden='#include *[<"](oneapi|tbb|embree|OpenEXR|Imath|Imf|CGAL|fmt|CLI)' included
  if grep -rnE "$forbidden" "$include"; then fail "the header of a library is in a public one"; fi
  for included in $(grep -rhoE '^#include [<"]dspm/[^>"]+' "$include" | sed 's|.*dspm/||' | sort -u); do
    [[ -f $include/$included ]] || fail "$included is included and not installed"
  done
  (cd "$include" && grep -rL '^#pragma message' --include '*.h' . | cut -c 3-) >"$work/headers"
  not_yet_compiled | some_of_them | xargs -P "$(nproc)" -I {} sh -c "echo '#include <dspm/{}>' | $compiler $flags -fsyntax-only -" ||
    fail "a header does not compile alone"
  stable_headers
  old_paths
  (($(wc -l <"$work/headers") > 40)) || fail "too few headers are installed"
}

# Each in a process of its own, as many at a time as there are cores: configuring keeps one busy.
each() {  # function, then its arguments, one a call
  export -f "$1" build fail
  export source_dir prefix dspm work compiler
  printf '%s\n' "${@:2}" | xargs -P "$(nproc)" -I {} bash -euo pipefail -c "$1 {}"
}

example() {
  local image
  cp -r "$source_dir/examples/$1" "$work/"
  build "$work/$1"
  image=$(find "$work/$1/build" -name "$1*.png" | head -n 1)
  [[ -s $image ]] || fail "$1 has rendered nothing"
}

# Not a plugin: links the library.
program() {
  cp -r "$source_dir/examples/$1" "$work/"
  build "$work/$1"
}

examples() {
  each example ambient lighttracer velvet roundbox
  program turntable
}

project() {
  local commands
  export CXX=$compiler CXXFLAGS="$warnings" CMAKE_GENERATOR=Ninja CMAKE_BUILD_TYPE=Release
  commands=$("$dspm" --new-plugin "$1" "my_${1//-/_}" "$work/what's new/$1")
  bash -ec "$commands" >"$work/$1.log" 2>&1 || { cat "$work/$1.log" >&2; fail "what --new-plugin $1 says fails with $compiler"; }
}

projects() { each project integrator material medium shape texture light area-light camera filter accelerator; }

# dspm's own plugins, one of each kind, with nothing changed but where they are registered, give the same images.
moved() {
  local folder=$work/moved files="materials/dielectric.cpp shapes/sphere.cpp textures/checkerboard.cpp lights/spot.cpp
    cameras/perspective.cpp accel/brute_force.cpp integrators/methods/dsppm/dsppm.cpp integrators/methods/dsppm/hj09.cpp
    integrators/methods/dsppm/kz11.cpp" file
  for file in $files integrators/methods/dsppm/dsppm.h integrators/methods/dsppm/four_frames.h accel/brute_force.h; do
    mkdir -p "$folder/dspm/$(dirname "$file")"
    cp "$source_dir/$file" "$folder/dspm/$file"
  done
  cp "$source_dir/tests/modules/moved/"* "$folder/"
  build "$folder"
}

"$task"
