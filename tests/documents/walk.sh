#!/usr/bin/env bash
# Adds up the lines of the files that README's walk names, and compares the sum with what README says below its table.
# usage: walk.sh <source directory>; exit 1 if they differ by more than 100 lines, or if a file is missing.
set -euo pipefail
cd "$1"

rows=$(sed -n '/^| step | file |/,/^$/p' README.md | tail -n +3)
[[ -n $rows ]] || { echo "README.md: there is no table that begins with | step | file |"; exit 1; }
said=$(sed -n 's/^Together these files have about \([0-9,]*\) lines.*/\1/p' README.md | tr -d ,)
[[ -n $said ]] || { echo "README.md: no line begins with \"Together these files have about N lines\""; exit 1; }

mapfile -t files < <(grep -oE '\]\([^)]+\)' <<<"$rows" | tr -d '])(' | LC_ALL=C sort -u)
lines=$(cat -- "${files[@]}" | wc -l) || { echo "README.md: its table names a file that is not there"; exit 1; }
echo "${#files[@]} files of $lines lines"
((lines - said <= 100 && said - lines <= 100)) || { echo "README.md says about $said lines: they are $lines"; exit 1; }
