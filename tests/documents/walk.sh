#!/usr/bin/env bash
# Adds up the lines of the files that README's walk names, then those of the headers that the ones of an iteration include
# as well, and compares both with what README says below its table.
# usage: walk.sh <source directory>; exit 1 if a sum differs by more than 100 lines from what is said, if it is more than a
# reader should be asked to read, or if a file is missing.
set -euo pipefail
cd "$1"
most_lines=3200
most_with_headers=6300

rows=$(sed -n '/^| step | file |/,/^$/p' README.md | tail -n +3)
[[ -n $rows ]] || { echo "README.md: there is no table that begins with | step | file |"; exit 1; }
said=$(sed -n 's/^Together these files have about \([0-9,]*\) lines, and about \([0-9,]*\) with .*/\1 \2/p' README.md | tr -d ,)
[[ -n $said ]] || { echo "README.md: no line begins with \"Together these files have about N lines, and about M with\""; exit 1; }
read -r said_lines said_with_headers <<<"$said"

sum() { cat -- "$@" | wc -l; }
mapfile -t files < <(grep -oE '\]\([^)]+\)' <<<"$rows" | tr -d '])(' | LC_ALL=C sort -u)
lines=$(sum "${files[@]}") || { echo "README.md: its table names a file that is not there"; exit 1; }
# An iteration reads no scene text, no parameters of plugins, and no files.
mapfile -t iteration < <(printf '%s\n' "${files[@]}" | grep -E '^(base|accel|integrators)/')
mapfile -t headers < <(sed -n 's|^#include "dspm/\(.*\)"$|\1|p' "${iteration[@]}" | grep -v '^base/params/' | LC_ALL=C sort -u)
mapfile -t all < <(printf '%s\n' "${files[@]}" "${headers[@]}" | LC_ALL=C sort -u)
with_headers=$(sum "${all[@]}")

echo "${#files[@]} files of $lines lines, ${#all[@]} of $with_headers with headers"
faults=0
check() {  # what it is, its lines, what README says, the most
  (($2 - $3 <= 100 && $3 - $2 <= 100)) || { echo "README.md says about $3 lines $1: they are $2"; faults=1; }
  (($2 <= $4)) || { echo "$1 there are $2 lines to read: at most $4 are fair"; faults=1; }
}
check "in the table" "$lines" "$said_lines" $most_lines
check "with the headers" "$with_headers" "$said_with_headers" $most_with_headers
exit $faults
