#!/usr/bin/env bash
# The packages that ./dev package makes: what the .deb depends on, what is in it and works where it is unpacked, and that
# the tarball needs nothing but the C and C++ libraries. usage: package.sh <source directory> <build directory>
set -euo pipefail
source_dir=$1 build_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DPKG_DEB_COMPRESSOR_TYPE=none ZSTD_CLEVEL=1

fail() {
  echo "$1" >&2
  exit 1
}

deb=$("$source_dir/cmake/package/deb.sh" "$build_dir" "$work")
depends=$(dpkg-deb --field "$deb" Depends)
for package in libc6 libstdc++6 libtbb12 libopenexr libpng16 libfmt; do
  [[ $depends == *"$package"* ]] || fail "the package does not depend on $package, only on: $depends"
done
[[ $depends != *-dev* ]] || fail "the package depends on headers: $depends"
[[ $depends != *mpi* ]] || fail "the package requires MPI, which few runs need: $depends"

dpkg-deb --raw-extract "$deb" "$work/root"
library=$(find "$work/root/usr/lib" -name libdspm.so)
libraries=$(dirname "$library")
for file in /usr/bin/dspm /usr/include/dspm/{session/modules/module.h,testing/agreement.h} /usr/share/doc/dspm/{copyright,changelog.gz} \
  /usr/share/man/man1/dspm.1.gz /usr/share/bash-completion/completions/dspm /usr/share/zsh/vendor-completions/_dspm \
  /usr/share/fish/vendor_completions.d/dspm.fish /usr/share/applications/dspm.desktop /usr/share/mime/packages/dspm.xml \
  /usr/share/icons/hicolor/scalable/apps/dspm.svg /usr/share/dspm/dspm_blender.zip \
  "${libraries#"$work/root"}"/{cmake/dspm/dspmConfig.cmake,pkgconfig/dspm.pc} \
  /usr/share/blender/scripts/addons/dspm_blender/__init__.py; do
  [[ -s $work/root$file ]] || fail "the package lacks $file"
done
version=$(LD_LIBRARY_PATH=$libraries "$work/root/usr/bin/dspm" --version | head -n 1)
[[ $version == "dspm $(dpkg-deb --field "$deb" Version)" ]] || fail "the program in the package says $version"
(cd "$work/root" && md5sum --quiet -c DEBIAN/md5sums) || fail "the package's sums are others'"

# What is built against the package finds it where it is now.
pkg_config() { PKG_CONFIG_PATH=$1/pkgconfig pkg-config "${@:2}"; }
if command -v pkg-config >/dev/null; then
  [[ $(pkg_config "$libraries" --modversion dspm) == "${version#dspm }" ]] || fail "pkg-config does not know the version"
  folder=$(pkg_config "$libraries" --variable=includedir dspm)
  [[ $folder -ef $work/root/usr/include ]] || fail "pkg-config says that the headers are in $folder"
  folder=$(pkg_config "$libraries" --variable=libdir dspm)
  [[ $folder -ef $libraries ]] || fail "pkg-config says that the library is in $folder"
fi

if ! command -v patchelf >/dev/null || ! command -v zstd >/dev/null; then
  echo "no patchelf or no zstd: the tarball is not tried" >&2
  exit 0
fi
tarball=$("$source_dir/cmake/package/tarball.sh" "$build_dir" "$work")
mkdir "$work/moved"
tar -C "$work/moved" --zstd -xf "$tarball"
folder=$(echo "$work"/moved/dspm-*)
unset LD_LIBRARY_PATH
"$folder/bin/dspm" --doctor --nthreads 1 >"$work/says" || fail "the program of the tarball cannot render: $(cat "$work/says")"
while read -r name _ path _; do
  [[ $path != /* || $path == "$folder/"* || $name =~ ^(ld-linux.*|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s))\.so ]] || fail "the tarball needs $path"
done < <(ldd "$folder/bin/dspm" $(find "$folder/lib" -name 'lib*.so.*') $(find "$folder/python" -name '*.so'))
! ldd "$folder/bin/dspm" | grep 'not found' || fail "the tarball lacks libraries"
[[ -s $folder/share/dspm/dspm_blender.zip ]] || fail "the tarball lacks the add-on"
