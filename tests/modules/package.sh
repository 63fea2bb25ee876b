#!/usr/bin/env bash
# The .deb that cpack makes: what it depends on, what is in it, and that the program in it runs where it is unpacked.
# usage: package.sh <build directory>
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$1/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
deb=$(echo "$work"/dspm_*.deb)

fail() {
  echo "$1" >&2
  exit 1
}

depends=$(dpkg-deb --field "$deb" Depends)
for package in libc6 libstdc++6 libtbb12 libopenexr libpng16 libfmt9; do
  [[ $depends == *"$package"* ]] || fail "the package does not depend on $package, only on: $depends"
done
[[ $depends != *-dev* ]] || fail "the package depends on headers: $depends"

dpkg-deb --extract "$deb" "$work/root"
for file in bin/dspm lib/libdspm.so lib/cmake/dspm/dspmConfig.cmake include/dspm/session/modules/module.h \
  include/dspm/testing/agreement.h share/doc/dspm/copyright; do
  [[ -e $work/root/usr/$file ]] || fail "the package lacks usr/$file"
done
version=$("$work/root/usr/bin/dspm" --version | head -n 1)
[[ $version == "dspm $(dpkg-deb --field "$deb" Version)" ]] || fail "the program in the package says $version"
