#!/usr/bin/env bash
# Checks which room includes what against the table in docs/design.md, that each library stays in its one place, and that
# no room becomes too large: at most 50 units (a header and its source), and headers on at most 8 floors.
# usage: check.sh <source directory>; exit 1 with file:line of everything that is wrong. Long files are a warning.
set -euo pipefail
cd "$1"

# The top level of the table's folders, but for those that include as authors of plugins do.
folders=()
for folder in $(sed -n 's/^| \([a-z/]*\) |.*/\1/p' docs/design.md | cut -d/ -f1 | LC_ALL=C sort -u); do
  [[ -d $folder && $folder != tests && $folder != examples ]] && folders+=("$folder")
done
find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' \) -print | LC_ALL=C sort | xargs awk '
BEGIN {
  # Headers of a library, and the only files that may include them.
  confined["^([a-z]mmintrin|arm_neon|simde/)"] = "^base/(math/simd|grid/points_within)[.]"  # the latter for AVX-512
  confined["^(oneapi/)?tbb/"] = "^base/system/parallel[.]"
  confined["^(OpenEXR/|Imath/|Imf|Imath|half[.]h)"] = "^image/exr(_[a-z]+)?[.]"
  confined["^OpenColorIO/"] = "^image/ocio_view[.]"
  confined["^embree[0-9]*/"] = "^accel/embree[.]"
  confined["^dspm/accel/embree[.]h"] = "^accel/embree_builder[.]"
  confined["^nlohmann/"] = "^lang/gltf/value[.]"
  confined["^draco/"] = "^lang/gltf/draco[.]"
  confined["^meshoptimizer[.]h"] = "^lang/gltf/meshopt[.]"
  confined["^nanovdb/"] = "^media/read_nanovdb[.]"
  confined["^openvdb/"] = "^media/openvdb/"
  confined["^boost/(asio|beast)"] = "^looking/serve/http_"
  confined["^CGAL/"] = "^(shapes/(cgal_mesh|mesh_check|mesh_repair|loopsubdiv)|scenes/generator/simplify)[.]"

  # Who names one of these includes its header, or leaves that to a header of its own name.
  home["FrameSet"] = home["Frame"] = home["kMaxFrames"] = "base/math/frames.h"
  home["FileFrame"] = home["Moment"] = "base/math/moments.h"
  home["Vec2"] = home["Vec3"] = "base/math/vec.h"
  home["Ray"] = "base/math/ray.h"
  home["Rgb"] = "base/colour/rgb.h"
  home["Image"] = "image/image.h"
  home["ParamReader"] = home["ParamList"] = "base/params/params.h"
  home["Scene"] = "world/scene/scene.h"

  most_units = 50
  most_floors = 8

  while ((getline line < "docs/design.md") > 0) {
    split(line, cell, "|")
    room = cell[2]
    gsub(/ /, "", room)
    if (line ~ /^[|] [a-z\/]+ [|]/ && room != "room" && room != "folder") included[room] = cell[4]
  }
  if (!("base/math" in included)) { print "docs/design.md: there is no table of rooms"; errors = 1; exit }
}

function wrong(message) {
  printf "%s:%d: %s\n", FILENAME, FNR, message
  ++errors
}

# The nearest folder that has a row in the table; folders within rooms have none.
function room_of(file) {
  while (sub(/\/[^\/]*$/, "", file))
    if (file in included) return file
  return ""
}

# Rows name rooms without their wings.
function may_include(room, other) {
  sub(/.*\//, "", other)
  if (included[room] ~ /everything but/) return included[room] !~ (other "( |$)")
  return included[room] ~ ("(^| )" other "( |$)")
}

# The floor on which a header stands: above all headers of its room that it includes.
function floor_of(header,    i, below, highest) {
  if (header in floor) return floor[header]
  if (header in being_climbed) {
    printf "%s: includes itself, by way of others\n", header
    ++errors
    return 0
  }
  being_climbed[header]
  for (i = 1; i <= count[header]; ++i) {
    below = floor_of(includes[header, i])
    if (room_of(includes[header, i]) == room_of(header) && below > highest) highest = below
  }
  delete being_climbed[header]
  return floor[header] = highest + 1
}

FNR == 401 { printf "%s: warning: more than 400 lines\n", FILENAME }

FNR == 1 {
  room = room_of(FILENAME)
  unit = FILENAME
  sub(/[.](h|cpp)$/, "", unit)
  if (!(unit in known_unit)) ++units[room]
  known_unit[unit]
}

/^[ \t]*#[ \t]*include[ \t]*["<]/ {
  header = $0
  sub(/^[^"<]*["<]/, "", header)
  sub(/[">].*$/, "", header)

  for (library in confined)
    if (header ~ library && FILENAME !~ confined[library] && room != "bench")
      wrong("<" header "> is only for " substr(confined[library], 2))
  if ($0 ~ /</) next

  split(FILENAME, part, "/")
  split(header, target, "/")
  if (target[1] != "dspm") {
    if (target[1] != part[1]) wrong("\"" header "\" must be written with its folder, from dspm/ on")
    next
  }
  sub(/^dspm\//, "", header)
  has[FILENAME, header] = 1
  other = room_of(header)
  if (room == "") wrong("no room in the table of docs/design.md holds this file")
  else if (other == "") wrong("no room in the table of docs/design.md holds " header)
  else if (other != room && !may_include(room, other)) wrong(room " may not include dspm/" header)
  if (FILENAME ~ /[.]h$/) includes[FILENAME, ++count[FILENAME]] = header
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
      printf "%s:%d: %s needs dspm/%s\n", of[1], first[use], of[2], home[of[2]] | "LC_ALL=C sort"
      ++errors
    }
  }
  close("LC_ALL=C sort")
  for (room in units)
    if (units[room] > most_units && room != "bench") {
      printf "%s: %d units, and a room has at most %d\n", room, units[room], most_units
      ++errors
    }
  for (header in count)
    if (floor_of(header) > most_floors) {
      printf "%s: stands on floor %d of its room, of at most %d\n", header, floor_of(header), most_floors
      ++errors
    }
  exit errors > 0
}'
