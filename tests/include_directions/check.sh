#!/usr/bin/env bash
# Checks which folder includes what (docs/design.md, Rooms) and that each library stays in its one place.
# usage: check.sh <source directory>; exit 1 with file:line of everything that is wrong. Long files are a warning.
set -euo pipefail
cd "$1"

find . -path ./build -prune -o -path ./.git -prune -o -path ./tests -prune -o \( -name '*.h' -o -name '*.cpp' \) -print |
  LC_ALL=C sort | sed 's|^\./||' | xargs awk '
BEGIN {
  # A folder may include itself and these, folders or single headers.
  allowed["core"] = ""
  allowed["lang"] = "core"
  allowed["image"] = "core"
  allowed["film"] = "core image"
  allowed["shapes"] = "core"
  allowed["textures"] = "core image"
  allowed["materials"] = "core textures shapes/shape.h"
  allowed["lights"] = "core image shapes"
  allowed["cameras"] = "core"
  allowed["accel"] = "core shapes"
  allowed["world"] = "core lang image shapes textures materials lights cameras accel"
  allowed["integrators"] = "core image film/pixel_filter.h film/pixel_rect.h world/scene.h accel/accel.h shapes/shape.h" \
      " shapes/placed_shape.h materials/bsdf.h materials/material.h lights/light.h cameras/camera.h"
  allowed["modules"] = "core shapes materials textures lights cameras accel world film/pixel_filter.h" \
      " integrators/integrator.h"
  allowed["examples"] = "*"
  allowed["app"] = allowed["bench"] = allowed["testing"] = "*"
  allowed["scenes"] = "core image shapes"

  # Headers of a library, and the only files that may include them.
  confined["^(oneapi/)?tbb/"] = "^core/parallel[.]"
  confined["^(OpenEXR/|Imath/|Imf|Imath|half[.]h)"] = "^image/exr[.]"
  confined["^CGAL/"] = "^(shapes/(cgal_mesh|mesh_check|mesh_repair|loopsubdiv)|scenes/generator/simplify)[.]"
}

function wrong(message) {
  printf "%s:%d: %s\n", FILENAME, FNR, message
  ++errors
}

function may_include(folder, header,    words, i, n) {
  if (allowed[folder] == "*") return 1
  n = split(allowed[folder], words, " ")
  for (i = 1; i <= n; ++i)
    if (header == words[i] || index(header, words[i] "/") == 1) return 1
  return 0
}

FNR == 401 { printf "%s: warning: more than 400 lines\n", FILENAME }

/^[ \t]*#[ \t]*include[ \t]*["<]/ {
  header = $0
  sub(/^[^"<]*["<]/, "", header)
  sub(/[">].*$/, "", header)
  folder = FILENAME
  sub(/\/.*/, "", folder)

  for (library in confined)
    if (header ~ library && FILENAME !~ confined[library] && folder != "bench")
      wrong("<" header "> is only for " substr(confined[library], 2))
  if ($0 ~ /</) next

  target = header
  sub(/\/.*/, "", target)
  if (header !~ /\//) wrong("\"" header "\" must be written with its folder")
  else if (!(folder in allowed)) wrong("the folder " folder " has no entry in the table of include directions")
  else if (target != folder && !may_include(folder, header)) wrong(folder " may not include " header)
}

END { exit errors > 0 }'
