#!/usr/bin/env bash
# Lets libFuzzer make up inputs for the fuzz targets, one target after the other, and says how many were tried.
# usage: run.sh <folder of the fuzz_* programs> <folder for what is found> <minutes> [targets]; exit 1 where one failed.
# Interesting inputs gather in <found>/<target>; what makes a target fail is <found>/<target>-crash-..., -oom-, -timeout-.
# DSPM_TEST_DATA: folder of foreign scenes that serve as further seeds.
set -euo pipefail
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
programs=$1 found=$2 minutes=$3
shift 3
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || mapfile -t targets < <(cd "$programs" && ls fuzz_* | sed 's/^fuzz_//')

# Twice as fast, and what is found is told in full when it is replayed.
export ASAN_OPTIONS=malloc_context_size=1:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}

failed=0
for target in "${targets[@]}"; do
  mkdir -p "$found/$target"
  corpora=("$found/$target" "$source_dir/tests/fuzz/corpus/$target")
  if [[ $target == scene ]]; then
    corpora+=("$source_dir/scenes")
    [[ -d ${DSPM_TEST_DATA:-}/data/parse-only ]] && corpora+=("$DSPM_TEST_DATA/data/parse-only")
  fi
  longest=2048  # bytes
  [[ $target == command_line ]] && longest=512  # each word costs more there
  options=(-max_total_time=$((minutes * 60 / ${#targets[@]})) -max_len=$longest -entropic=0 -timeout=5 -rss_limit_mb=1500
    -artifact_prefix="$found/$target-" -print_final_stats=1 -verbosity=0)
  dictionary=$source_dir/tests/fuzz/dictionaries/$target.txt
  [[ -f $dictionary ]] && options+=(-dict="$dictionary")
  log=$found/$target.log
  verdict=ok
  "$programs/fuzz_$target" "${options[@]}" "${corpora[@]}" >"$log" 2>&1 || { verdict="FAILED, see $log"; failed=1; }
  awk -v target="$target" -v verdict="$verdict" '
    /number_of_executed_units/ { tried = $2 }
    /average_exec_per_sec/ { rate = $2 }
    END { printf "%-14s %12d inputs, %7d a second: %s\n", target, tried, rate, verdict }' "$log"
done
exit $failed
