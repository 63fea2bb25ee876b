#!/usr/bin/env bash
# The digest of the interface sees added functions and swapped fields, and no comments.
# usage: interface_digest.sh <source directory>
set -euo pipefail
source_dir=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

digest() {
  cmake -D FOLDER="$work/dspm" -P "$source_dir/cmake/interface_digest.cmake"
}

copy_headers() {
  rm -rf "$work/dspm" && mkdir "$work/dspm"
  (cd "$source_dir" && grep -oE '[a-z_/]+/[a-z0-9_]+\.h' cmake/public_headers.cmake | xargs cp --parents -t "$work/dspm")
}

changed() {  # file, sed expression
  copy_headers
  sed -i "$2" "$work/dspm/$1"
  ! cmp -s "$work/dspm/$1" "$source_dir/$1" || { echo "sed \"$2\" finds nothing in $1" >&2; exit 1; }
  [[ $(digest) != "$before" ]]
}

copy_headers
before=$(digest)
changed lights/light.h 's|  virtual Rgb power() const = 0;|&\n  virtual int more() const = 0;|' ||
  { echo "an added function is not seen" >&2; exit 1; }
changed lights/emission.h '/^  float distance;/{h;d};/^  Vec3 wi; /{p;G}' || { echo "swapped fields are not seen" >&2; exit 1; }
changed lights/light.h 's|^// .*|& Another word.|' && { echo "a comment counts" >&2; exit 1; }
exit 0
