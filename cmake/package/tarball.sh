#!/usr/bin/env bash
# Makes a folder that runs from anywhere, and packs it. It holds the libraries that dspm needs beyond those that every
# system has: the C and the C++ library. Its Python module is for the Python that the build has found and, for each root of
# another system with python3-dev and pybind11-dev in it, for that system's Python.
# usage: tarball.sh <build directory> <output folder> [<root>...]
set -euo pipefail
build=$(realpath "$1") output=$(realpath "$2") source=$(realpath "$(dirname "$0")/../..")
shift 2
version=$("$build/dspm" --version | sed -n '1s/dspm //p')
name=dspm-${version%.0}-linux-$(uname -m)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
folder=$work/$name
umask 022

quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
}

quietly cmake --install "$build" --prefix "$folder" --strip
libraries=$(dirname "$(find "$folder/lib" -name libdspm.so)")
from_python='$ORIGIN/../../'${libraries#"$folder/"}

# Every Python looks into one folder, for a module of its version.
modules=$(dirname "$(find "$folder/lib" -path '*/dspm/__init__.py')")
if [[ -d $modules ]]; then
  mkdir "$folder/python"
  mv "$modules" "$folder/python/dspm"
  find "$folder/lib" -name 'python3*' -prune -exec rm -r {} +
fi
module_of() {  # root of a system: compiles the module against its headers, with this system's C library
  local root=$1 headers version
  headers=$(echo "$root"/usr/include/python3.*)
  version=${headers##*python3.}
  mkdir -p "$work/include"
  ln -sfT "$root/usr/include/pybind11" "$work/include/pybind11"
  quietly g++ $(sed -n 's/^Cflags: -I[^ ]*//p' "$build/dspm.pc") -O2 -fPIC -shared -fvisibility=hidden -DNDEBUG \
    -I "$build/include" -I "$build/made" -I "$source" -isystem "$headers" -isystem "$work/include" \
    -idirafter "$root/usr/include" "$source"/python/*.cpp -L "$libraries" -ldspm -lfmt -s \
    -o "$folder/python/dspm/_dspm.cpython-3$version-$(uname -m)-linux-gnu.so"
}
for root in "$@"; do module_of "$root"; done

# Copies what these files need, with its licence.
needs() { LD_LIBRARY_PATH=$libraries ldd "$@" | sed -n 's/.* => \(\/[^ ]*\) (.*/\1/p' | sort -u; }
is_everywhere='/(ld-linux.*|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s))\.so'
openvdb_module=$(find "$libraries" -name libdspm_openvdb.so)
mapfile -t needed < <(needs "$folder/bin/dspm" "$libraries/libdspm.so" $openvdb_module "$folder"/python/dspm/*.so |
  grep -vE "$is_everywhere|/libdspm\.so")
for library in "${needed[@]}"; do
  cp -L "$library" "$libraries/"
  patchelf --set-rpath '$ORIGIN' "$libraries/$(basename "$library")"
done
# dpkg takes a second for a question, whatever it is, and knows some of the files below /lib, which is /usr/lib by now.
if command -v dpkg-query >/dev/null; then
  realpath "${needed[@]}" >"$work/files"
  sed 'p; s|^/usr||' "$work/files" | xargs dpkg-query -S 2>/dev/null | grep -v '^diversion' >"$work/owners" || true
  while read -r file; do
    package=$(sed -n "s|:.* \(/usr\)\?${file#/usr}\$||p" "$work/owners" | head -n 1)
    [[ $package ]] || { echo "no package holds $file, so its licence is unknown" >&2; exit 1; }
    mkdir -p "$folder/share/doc/libraries/$package"
    cp -L "/usr/share/doc/$package/copyright" "$folder/share/doc/libraries/$package/"
  done <"$work/files"
fi
for library in "$libraries/libdspm.so" $openvdb_module; do patchelf --set-rpath '$ORIGIN' "$library"; done
for module in "$folder"/python/dspm/*.so; do patchelf --set-rpath "$from_python" "$module"; done

export ZSTD_CLEVEL=${ZSTD_CLEVEL:-15}
tarball=$output/$name.tar.zst
date=$(git -C "$source" log -1 --format=%at 2>/dev/null || date +%s)
tar --create --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$date" -C "$work" -I 'zstd -q' -f "$tarball" "$name"
echo "$tarball"
