#!/usr/bin/env bash
# Makes a folder of arm64 packages that a cross compiler and qemu-user take for a system: what dspm is built from, by
# tools/packages.txt, of this Debian. No program of it is run. usage: arm64_root.sh <folder>, as root
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. tools/packages.sh
folder=$1
[[ ! -e $folder/.made ]] || exit 0

suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
here='g++|cmake|ninja-build'  # what runs where it is built
libraries=$(packages apt build extra simd | grep -vxE "$here" | paste -sd ,)
rm -rf "$folder"
mkdir -p "$(dirname "$folder")"
mmdebstrap --quiet --variant=extract --architectures=arm64 --include="$libraries" "$suite" "$folder"

# A link to /lib means this folder's.
find "$folder" -type l -lname '/*' | while read -r link; do
  ln -sfnr "$folder$(readlink "$link")" "$link"
done
touch "$folder/.made"
