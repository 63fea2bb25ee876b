#!/usr/bin/env bash
# Tries --device gpu on a machine with an NVIDIA card: builds, compares images with the CPU's bit by bit, looks for faults
# of memory, and measures. What fails does not keep the rest from being tried; a step ends when its time is over.
# usage: gpu_check.sh <log> [steps], by default all in this order; exit 1 if something failed
#   build      the program, its module for GPUs, the evaluation; the horse's meshes        540 s at most
#   images     scenes, integrators and settings against the CPU                            150 s
#   kinds      small scenes of all kinds that devices trace                                120 s
#   again      the same twice; frames alone; resumed by the CPU, and from it                60 s
#   sanitizer  compute-sanitizer, where it is, on a very small render, with each tool      240 s
#   measure    ./dev bench device, printed                                                 400 s
# DSPM_DEVICE=waves tries the script itself where there is no card. DSPM_TEST_DATA: where foreign scenes are. DSPM_QUICK=1:
# fewer iterations and frames are measured, on few cores.
set -uo pipefail
log=$(realpath -m "${1:-}")
[[ -z ${DSPM_TEST_DATA:-} ]] || DSPM_TEST_DATA=$(realpath "$DSPM_TEST_DATA")
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit
device=${DSPM_DEVICE:-gpu}
data=${DSPM_TEST_DATA:-../shared}
dspm=$PWD/build/release/dspm
export DSPM_INSTALL=${DSPM_INSTALL:-no}

declare -A seconds=([build]=540 [images]=150 [kinds]=120 [again]=60 [sanitizer]=240 [measure]=400)
all_steps=(build images kinds again sanitizer measure)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() {  # PASSED, FAILED or SKIPPED, and what
  printf '%-8s %4d s  %s\n' "$1" $SECONDS "$2"
}
# Runs a command for as long as the step may take. Its last lines are shown if it fails.
bounded() {
  local left=$((deadline - SECONDS)) result
  ((left > 0)) || { echo "the step's time is over"; return 124; }
  timeout -k 5 $left "$@" >"$work/output" 2>&1
  result=$?
  ((result != 124 && result != 137)) || echo "the step's time is over" >>"$work/output"
  ((result == 0)) || tail -n 12 "$work/output" | cut -c -300 | sed 's/^/    /'
  return $result
}
passes() {  # what, then a command
  local what=$1
  shift
  if bounded "$@"; then say PASSED "$what"; else say FAILED "$what"; fi
}

# Scenes are read from standard input in their own folder, so that their text can be changed: photons that bring all direct
# light let camera paths go on the device as well.
scene_text() {  # file, parameters of the integrator
  sed "s|^Integrator \"[a-z]*\"|& $2|" "$1"
}
render() {  # folder for the images, scene, parameters of the integrator, options of dspm
  local to=$work/$1 scene=$2 parameters=$3
  shift 3
  rm -rf "$to" && mkdir -p "$to"
  scene_text "$scene" "$parameters" >"$work/scene.dsc"
  bounded bash -c 'cd "$1" && shift && exec "$@" <'"$work/scene.dsc" - "$(dirname "$scene")" \
    "$dspm" - "$@" --quiet -o "$to/frame.####.pfm"
}
same() {  # what, two folders of images
  local result
  if result=$(tools/pfm_pixels.py "$work/$2" "$work/$3" 2>&1); then say PASSED "$1: $result"; else say FAILED "$1: $result"; fi
}
against_cpu() {  # what, scene, parameters, options
  local what=$1
  shift
  if [[ ! -f $1 ]]; then say SKIPPED "$what: there is no $1"; return; fi
  render cpu "$@" && render device "$@" --device "$device" || { say FAILED "$what"; return; }
  same "$what" cpu device
}

machine() {
  echo "== $(date -u +%FT%TZ), $(git describe --always --exclude='*' 2>/dev/null || echo 'no commit'), --device $device"
  { nvidia-smi -L; nvcc --version || /usr/local/cuda/bin/nvcc --version; } 2>/dev/null | grep -E '^GPU|release' | sed 's/ (UUID.*//'
  echo "$(nproc) cores, $(${CXX:-g++} --version | head -n 1)"
}

try_build() {
  bounded cmake --preset release ${DSPM_TEST_DATA:+-DDSPM_TEST_DATA="$DSPM_TEST_DATA"} || true
  passes "build: dspm and the evaluation" ./dev build release dspm evaluate
  if [[ -f build/release/libdspm_cuda.so ]]; then say PASSED "build: the module for GPUs"
  elif [[ $device == gpu ]]; then say FAILED "build: there is no module for GPUs: see build/release/configure.log"
  else say SKIPPED "build: the module for GPUs"; fi
  [[ -e scenes/meshes/animal.000.ply ]] || passes "build: the horse's meshes" ./dev scenes hall animal
}

try_images() {
  local small=(--resolution 96x72 --photons 20000 --iterations 4) direct='"string direct" "photons"'
  local demo=$PWD/scenes/demo.dsc horse=$PWD/scenes/horse.dsc open=$data/bench/open.dsc
  [[ -e scenes/meshes/animal.000.ply ]] || { say SKIPPED "images: horse: its meshes have not been made"; horse=; }
  against_cpu "images: demo" "$demo" "" "${small[@]}"
  against_cpu "images: demo, direct light by photons" "$demo" "$direct" "${small[@]}"
  against_cpu "images: demo, by rays" "$demo" '"string direct" "sampled"' "${small[@]}"
  against_cpu "images: demo, indirect light by paths" "$demo" '"string indirect" "paths"' "${small[@]}"
  against_cpu "images: demo, indirect light by photons" "$demo" '"string indirect" "photons"' "${small[@]}"
  against_cpu "images: demo, hj09" "$demo" "$direct \"string estimator\" \"hj09\"" "${small[@]}"
  against_cpu "images: demo, sppm" "$demo" "$direct" "${small[@]}" --integrator sppm
  against_cpu "images: demo, photons by the lights' power" "$demo" "$direct \"string emission\" \"power\"" "${small[@]}"
  against_cpu "images: demo, noise of its own in each frame" "$demo" "$direct" "${small[@]}" --noise perframe
  against_cpu "images: demo, within 100 MB" "$demo" "$direct" "${small[@]}" --memory 100M
  against_cpu "images: demo, more photons than a wave has" "$demo" "$direct" --resolution 96x72 --photons 1200000 --iterations 2
  if [[ -n $horse ]]; then
    against_cpu "images: horse" "$horse" "" "${small[@]}"
    against_cpu "images: horse, direct light by photons" "$horse" "$direct" "${small[@]}"
    against_cpu "images: horse, sppm" "$horse" "$direct" "${small[@]}" --integrator sppm
  fi
  against_cpu "images: open" "$open" "" "${small[@]}"
  against_cpu "images: open, direct light by photons" "$open" "$direct" "${small[@]}"
  against_cpu "images: demo at its full size" "$demo" "$direct" --iterations 4
}

# The scenes that systems are compared by, on a ground that devices know.
try_kinds() {
  local scene name tried=0 left_out=0 faults=0 result
  fault() { faults=$((faults + 1)) && say FAILED "kinds: $1"; }
  tools/everywhere/scenes.py "$work/kinds" || { say FAILED "kinds: their scenes cannot be written"; return; }
  sed -i 's|"coateddiffuse" \("rgb reflectance" \[0.5 0.4 0.3\]\) "float roughness" 0.2|"diffuse" \1|' "$work"/kinds/*.dsc
  rm "$work/kinds/film-gbuffer.dsc"  # it has more than a PFM file holds
  for scene in "$work"/kinds/*.dsc; do
    name=$(basename "$scene" .dsc)
    if ! grep -qE '^Integrator "(dspp|spp)m"' "$scene"; then continue; fi
    if ! render device "$scene" '"string direct" "photons"' --device "$device" >"$work/said"; then
      if grep -q 'cannot be traced in waves' "$work/said"; then left_out=$((left_out + 1)); continue; fi
      cat "$work/said"
      fault "$name"
    elif render cpu "$scene" '"string direct" "photons"'; then
      result=$(tools/pfm_pixels.py "$work/cpu" "$work/device" 2>&1) || fault "$name: $result"
    else
      fault "$name, on the CPU"
    fi
    tried=$((tried + 1))
    ((SECONDS < deadline)) || break
  done
  if ((faults == 0 && tried > 0)); then say PASSED "kinds: $tried scenes; $left_out others are none for devices"
  else say FAILED "kinds: $faults of $tried scenes"; fi
  against_cpu "kinds: spectral" "$work/kinds/usual.dsc" '"string direct" "photons"' --colour spectral
}

try_again() {
  local demo=$PWD/scenes/demo.dsc direct='"string direct" "photons"' small=(--resolution 96x72 --photons 20000)
  local on=(--device "$device") off=(--device cpu)
  render first "$demo" "$direct" "${small[@]}" "${on[@]}" --iterations 6 &&
    render second "$demo" "$direct" "${small[@]}" "${on[@]}" --iterations 6 && same "again: twice" first second ||
    say FAILED "again: twice"
  # Together and alone, dsppm's images differ by rounding, on the CPU as well; those of sppm do not.
  against_cpu "again: frame 5 alone" "$demo" "$direct" "${small[@]}" --iterations 6 --frames 5
  render some "$demo" "$direct" "${small[@]}" "${on[@]}" --iterations 6 --integrator sppm --frames 5 &&
    render all "$demo" "$direct" "${small[@]}" "${on[@]}" --iterations 6 --integrator sppm &&
    find "$work/all" -name '*.pfm' ! -name '*0005.pfm' -delete && same "again: frame 5 alone and among all, sppm" some all ||
    say FAILED "again: frame 5 alone and among all, sppm"
  resumed "again: begun on the CPU" off on
  resumed "again: resumed on the CPU" on off
}
resumed() {  # what, names of two arrays: the device's options at first, and then
  local -n before=$2 after=$3
  rm -f "$work/checkpoint"
  render half "$demo" "$direct" "${small[@]}" "${before[@]}" --iterations 3 --checkpoint "$work/checkpoint" &&
    render resumed "$demo" "$direct" "${small[@]}" "${after[@]}" --iterations 6 --resume "$work/checkpoint" &&
    render whole "$demo" "$direct" "${small[@]}" --iterations 6 || { say FAILED "$1"; return; }
  same "$1" resumed whole
}

try_sanitizer() {
  local sanitizer tool
  sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null)
  if [[ -z $sanitizer || $device != gpu ]]; then say SKIPPED "sanitizer: there is no compute-sanitizer, or nothing for it"; return; fi
  scene_text scenes/demo.dsc '"string direct" "photons"' >"$work/scene.dsc"
  for tool in memcheck initcheck racecheck; do
    deadline=$((SECONDS + seconds[sanitizer] / 3))
    passes "sanitizer: $tool" "$sanitizer" --tool $tool --error-exitcode 9 --print-limit 10 "$dspm" "$work/scene.dsc" --device gpu \
      --resolution 16x12 --photons 500 --iterations 2 --quiet -o "$work/frame.####.pfm"
    grep -E 'ERROR SUMMARY|RACECHECK SUMMARY' "$work/output" | sed 's/^/    /'
  done
}

# The evaluation says for itself if there is no GPU.
try_measure() {
  if ! bounded build/release/bench/evaluate --print ${DSPM_QUICK:+--quick} machine device; then say FAILED "measure"; return; fi
  cat "$work/output"
  if grep -qE '\| [1-9][0-9]* of [0-9]+ \|$' "$work/output"; then say FAILED "measure: pixels differ"
  elif grep -qE '^(SKIPPED|No figures)' "$work/output"; then say SKIPPED "measure: some figures"
  else say PASSED "measure"; fi
}

try_all() {
  local step
  machine
  for step in "$@"; do
    echo "== $step"
    deadline=$((SECONDS + ${seconds[$step]}))
    "try_$step"
  done
}

[[ $# -ge 1 ]] || { sed -n '2,/^set/p' "${BASH_SOURCE[0]}" | sed '$d; s/^# \{0,1\}//' >&2; exit 2; }
shift
[[ $# -gt 0 ]] || set -- "${all_steps[@]}"
for step in "$@"; do
  [[ -n ${seconds[$step]:-} ]] || { echo "gpu_check: there is no step $step" >&2; exit 2; }
done
try_all "$@" 2>&1 | tee "$log"
count() { grep -c "^$1" "$log"; }
echo "== $(count PASSED) passed, $(count FAILED) failed, $(count SKIPPED) skipped" | tee -a "$log"
[[ $(count FAILED) == 0 ]]
