#!/usr/bin/env bash
# Checks which room includes what against the table in docs/design.md, and that each library stays in its one place.
# usage: check.sh <source directory>; exit 1 with file:line of everything that is wrong. Long files are a warning.
set -euo pipefail
cd "$1"

find dspm bench scenes python \( -name '*.h' -o -name '*.cpp' \) -print 2>/dev/null | LC_ALL=C sort | xargs awk '
BEGIN {
  # Headers of a library, and the only files that may include them.
  confined["^(oneapi/)?tbb/"] = "^dspm/system/parallel[.]"
  confined["^(OpenEXR/|Imath/|Imf|Imath|half[.]h)"] = "^dspm/image/exr(_[a-z]+)?[.]"
  confined["^OpenColorIO/"] = "^dspm/image/ocio_view[.]"
  confined["^embree[0-9]*/"] = "^(dspm/accel/embree_builder|bench/measure/bare_embree)[.]"
  confined["^nlohmann/"] = "^dspm/gltf/value[.]"
  confined["^draco/"] = "^dspm/gltf/draco[.]"
  confined["^meshoptimizer[.]h"] = "^dspm/gltf/meshopt[.]"
  confined["^boost/(asio|beast)"] = "^dspm/serve/http_"
  confined["^CGAL/"] = "^(dspm/shapes/(cgal_mesh|mesh_check|mesh_repair|loopsubdiv)|scenes/generator/simplify)[.]"

  # Who names one of these includes its header, or leaves that to a header of its own name.
  home["FrameSet"] = home["Frame"] = home["FileFrame"] = home["Moment"] = home["kMaxFrames"] = "dspm/math/frames.h"
  home["Vec2"] = home["Vec3"] = "dspm/math/vec.h"
  home["Ray"] = "dspm/math/ray.h"
  home["Rgb"] = "dspm/colour/rgb.h"
  home["Image"] = "dspm/image/image.h"
  home["ParamReader"] = home["ParamList"] = "dspm/params/params.h"
  home["Scene"] = "dspm/scene/scene.h"

  while ((getline line < "docs/design.md") > 0) {
    split(line, cell, "|")
    room = cell[2]
    gsub(/ /, "", room)
    if (line ~ /^[|] [a-z]+ [|]/ && room != "room" && room != "folder") included[room] = cell[4]
  }
  if (!("math" in included)) { print "docs/design.md: there is no table of rooms"; errors = 1; exit }
}

function wrong(message) {
  printf "%s:%d: %s\n", FILENAME, FNR, message
  ++errors
}

function may_include(room, other) {
  if (included[room] ~ /everything but/) return included[room] !~ (other "( |$)")
  return included[room] ~ ("(^| )" other "( |$)")
}

FNR == 401 { printf "%s: warning: more than 400 lines\n", FILENAME }

/^[ \t]*#[ \t]*include[ \t]*["<]/ {
  header = $0
  sub(/^[^"<]*["<]/, "", header)
  sub(/[">].*$/, "", header)
  has[FILENAME, header] = 1
  n = split(FILENAME, part, "/")
  room = part[1] == "dspm" ? part[2] : part[1]

  for (library in confined)
    if (header ~ library && FILENAME !~ confined[library] && room != "bench")
      wrong("<" header "> is only for " substr(confined[library], 2))
  if ($0 ~ /</) next

  split(header, target, "/")
  if (target[1] != "dspm") {
    if (target[1] != room) wrong("\"" header "\" must be written with its folder, from dspm/ on")
  } else if (!(room in included)) wrong("the room " room " has no row in the table of docs/design.md")
  else if (target[2] != room && !may_include(room, target[2])) wrong(room " may not include " header)
}

# Names in comments and texts are no uses; a declaration ahead is enough where the header is not needed.
!/^[ \t]*(#|\/\/)/ {
  gsub(/"([^"\\]|\\.)*"|\/\/.*/, "")
  for (name in home)
    if ($0 ~ ("(^|[^A-Za-z0-9_:.])" name "($|[^A-Za-z0-9_])")) {
      if ($0 ~ ("^ *(class|struct) " name ";")) has[FILENAME, home[name]] = 1
      if (!((FILENAME, name) in first)) first[FILENAME, name] = FNR
    }
}

END {
  for (use in first) {
    split(use, of, SUBSEP)
    own = of[1]
    sub(/[.]cpp$/, ".h", own)
    if (of[1] != home[of[2]] && !((of[1], home[of[2]]) in has) && !((own, home[of[2]]) in has)) {
      printf "%s:%d: %s needs %s\n", of[1], first[use], of[2], home[of[2]] | "LC_ALL=C sort"
      ++errors
    }
  }
  close("LC_ALL=C sort")
  exit errors > 0
}'
