#!/usr/bin/env bash
# Makes a .deb of a build for the system that made it. usage: deb.sh <build directory> <output folder>
set -euo pipefail
build=$(realpath "$1") output=$(realpath "$2") here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
architecture=$(dpkg --print-architecture)
maintainer="${DEBFULLNAME:-The authors of dspm} <${DEBEMAIL:-dspm@example.org}>"
stage=$work/debian/dspm
umask 022

quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
}

quietly env DESTDIR="$stage" cmake --install "$build" --prefix /usr --strip
libraries=$(dirname "$(find "$stage/usr/lib" -name 'libdspm.so')")
program=$stage/usr/bin/dspm
python_module=$(find "$stage/usr/lib" -name '_dspm.*.so')
modules=$(find "$libraries" -name 'libdspm_mpi.so' -o -name 'libdspm_openvdb.so' -o -name 'libdspm_cuda.so')
version=$("$build/dspm" --version | sed -n '1s/dspm //p')
soversion=$(objdump -p "$libraries/libdspm.so" | sed -n 's/.*SONAME *libdspm\.so\.//p')

# The library is where the loader looks anyway.
for file in "$program" $python_module; do
  echo "file(RPATH_REMOVE FILE \"$file\")" >"$work/remove.cmake"
  quietly cmake -P "$work/remove.cmake"
done
chmod 644 "$libraries"/lib*.so.* $python_module $modules

# Debian's Blender finds the add-on there; other Blenders install the zip.
addons=$stage/usr/share/blender/scripts/addons
mkdir -p "$addons"
(cd "$addons" && cmake -E tar xf "$stage/usr/share/dspm/dspm_blender.zip")

documents=$stage/usr/share/doc/dspm
cp "$here/copyright" "$documents/copyright"
date=$(git -C "$here" log -1 --format=%aD 2>/dev/null || date -R)
cat >"$documents/changelog" <<END
dspm ($version) unstable; urgency=medium

  * Version $version.

 -- $maintainer  $date
END
gzip -9n "$documents/changelog" "$stage/usr/share/man/man1/dspm.1"
find "$stage" -type d -exec chmod 755 {} +

mkdir "$stage/DEBIAN"
cp "$here/postinst" "$here/prerm" "$stage/DEBIAN/"
chmod 755 "$stage/DEBIAN/postinst" "$stage/DEBIAN/prerm"
echo "activate-noawait ldconfig" >"$stage/DEBIAN/triggers"
echo "libdspm $soversion dspm (>= $version)" >"$stage/DEBIAN/shlibs"
(cd "$stage" && find usr -type f -print0 | sort -z | xargs -0 md5sum) >"$stage/DEBIAN/md5sums"

# What the linked libraries' packages are called here. What only some runs need is recommended.
printf 'Source: dspm\n\nPackage: dspm\nArchitecture: any\n' >"$work/debian/control"
(cd "$work" && dpkg-shlibdeps -O -xdspm -l"$libraries" -dDepends "$program" "$libraries/libdspm.so" $python_module \
  ${modules:+-dSuggests $modules}) >"$work/dependencies" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
needed() { sed -n "s/^shlibs:$1=//p" "$work/dependencies"; }
recommended=
if [[ $python_module ]]; then
  minor=$(basename "$python_module" | sed 's/.*cpython-3\([0-9]*\)-.*/\1/')
  recommended="python3 (>= 3.$minor~), python3 (<< 3.$((minor + 1))), python3-numpy"
fi
suggested=$(needed Suggests)
[[ $architecture == amd64 ]] || suggested+="${suggested:+, }libsimde-dev"  # for headers of plugins

cat >"$stage/DEBIAN/control" <<END
Package: dspm
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Section: graphics
Priority: optional
Installed-Size: $(du -k -s --apparent-size "$stage/usr" | cut -f 1)
Depends: $(needed Depends)
${recommended:+Recommends: $recommended
}Suggests: ${suggested:+$suggested, }blender, cmake, ffmpeg, g++, make, openmpi-bin
Description: renderer of all frames of a scene together
 dspm renders all frames of an animation, or all variations of a product,
 together: what is the same in several frames is computed once. It is made for
 caustics, which it renders by Dynamic Stochastic Progressive Photon Mapping,
 and reads scenes in the format of pbrt-v4 and glTF.
 .
 With it come its library and headers for plugins, a module for Python, and an
 add-on for Blender.
END
deb=$output/dspm_${version}_$architecture.deb
quietly dpkg-deb --root-owner-group --build "$stage" "$deb"
echo "$deb"
