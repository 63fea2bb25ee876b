#!/usr/bin/env bash
# What docs/building.md promises of systems, tried on bare ones: in a debootstrap of each, ./dev demo and ./dev test, a
# build with clang, a wheel in a venv, the add-on in its Blender, a build for arm64; then the images of one system and
# processor against the other's.
# usage: everywhere.sh [suite...] (default: bookworm trixie), as root. What is done is not done again; the roots and logs
# are in build/everywhere, and the report is out/everywhere.md.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
suites=("$@")
(($#)) || suites=(bookworm trixie)
work=$PWD/build/everywhere
mirror=${DSPM_MIRROR:-http://deb.debian.org/debian}
steps=(demo test clang wheel blender images arm64)
mkdir -p "$work" out

# A step's commands, in a copy of the tracked files.
demo='./dev demo && test -s out/demo.png'
test='./dev test'
clang='./dev build clang dspm'
wheel='apt-cache show python3-scikit-build-core >/dev/null 2>&1 || exit 77; . tools/packages.sh && apt-get install -qq -y --no-install-recommends $(packages apt wheel) >/dev/null &&
  rm -rf /tmp/venv && python3 -m venv --system-site-packages /tmp/venv &&
  /tmp/venv/bin/pip install -q --no-build-isolation --no-deps . && cd /tmp &&
  venv/bin/python -c "import dspm; r = dspm.Render(dspm.load(\"/dspm/scenes/demo.dsc\", resolution=0.1)); r.iterate(1); assert r.image(0).any()" &&
  venv/bin/dspm /dspm/scenes/demo.dsc --quick --iterations 1 --resolution 10% -o /tmp/wheel.####.exr --quiet'
blender='apt-get install -qq -y --no-install-recommends blender python3-numpy >/dev/null &&
  ctest --test-dir build/release -R ^blender/ --output-on-failure'
images='for preset in release clang; do
    rm -rf /images/$preset && mkdir -p /images/$preset && tools/everywhere/scenes.py /tmp/scenes || exit 1
    for scene in /tmp/scenes/*.dsc; do
      build/$preset/dspm $scene -o /images/$preset/$(basename $scene .dsc).####.exr --float --compression none --quiet || exit 1
    done
  done'
# What is statistical, and accel/agreement, take many minutes under qemu.
arm64='rooms="math colour grid image film textures shapes cameras lights accel"
  ./dev build arm64 dspm $(printf "%s_tests " $rooms) || exit 1
  ctest --test-dir build/arm64 -R "^(${rooms// /|})/" -LE statistical -E "^accel/agreement" --output-on-failure || exit 1
  rm -rf /images/arm64 && mkdir -p /images/arm64 && tools/everywhere/scenes.py /tmp/scenes || exit 1
  for scene in /tmp/scenes/*.dsc; do
    qemu-aarch64-static -L build/arm64-root build/arm64/dspm $scene -o /images/arm64/$(basename $scene .dsc).####.exr \
      --float --compression none --quiet || exit 1
  done'

# A bare system, and in it a copy of what git has.
prepare() {  # suite
  local root=$work/$1
  if [[ ! -e $root/.made ]]; then
    rm -rf "$root"
    debootstrap --variant=minbase --include=ca-certificates "$1" "$root" "$mirror" >"$work/$1.debootstrap.log" 2>&1 || return
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"  # it need not survive a crash
    touch "$root/.made"
  fi
  mkdir -p "$root/dspm"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  git ls-files -z | tar --null -T - -cf - | tar -xf - -C "$root/dspm"
}

inside() {  # suite, commands; mounts end with the process that made them
  unshare --mount --pid --fork bash -c '
    mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" &&
      exec chroot "$0" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        DEBIAN_FRONTEND=noninteractive bash -c "cd /dspm && $1"' "$work/$1" "$2"
}

# What a system has no packages for is said by exit code 77.
try() {  # suite, step
  local log=$work/$1.$2.log begun=$SECONDS result
  [[ -e $work/$1.$2.done ]] && return
  inside "$1" "${!2}" >"$log" 2>&1
  case $? in
    0) result="ok, $((SECONDS - begun)) s" ;;
    77) result="no packages" ;;
    *) result=failed ;;
  esac
  echo "$1: $2: $result ($log)"
  [[ $result == failed ]] || echo "$result" >"$work/$1.$2.done"
}

versions() {  # suite
  inside "$1" 'dpkg-query -W -f "\${Package} \${Version}\n" g++ clang cmake libembree-dev libcgal-dev libtbb-dev libopenexr-dev libfmt-dev blender 2>/dev/null' |
    awk '{ sub(/^[0-9]+:/, "", $2); sub(/[-+].*/, "", $2); printf "%s%s %s", (NR > 1 ? ", " : ""), $1, $2 }'
}

report() {
  local suite step line
  echo "As of $(date -u +%Y-%m-%d), $(git rev-parse --short HEAD), by \`./dev everywhere\`:"
  echo
  echo "| system | with | $(printf '%s | ' "${steps[@]}")"
  echo "| --- | --- | $(printf -- '--- | %.0s' "${steps[@]}")"
  for suite in "${suites[@]}"; do
    line="| $suite | $(versions "$suite") |"
    for step in "${steps[@]}"; do
      line+=" $(cat "$work/$suite.$step.done" 2>/dev/null || echo failed) |"
    done
    echo "$line"
  done
  echo
  for suite in "${suites[@]}"; do
    for preset in release clang arm64; do
      echo "* ${suites[0]}, release against $suite, $preset: $(tools/everywhere/pixels.py \
        "$work/${suites[0]}/images/release" "$work/$suite/images/$preset" 2>&1 | head -n 1)"
    done
  done
}

[[ $EUID -eq 0 ]] || { echo "everywhere: to be run as root: it makes systems with debootstrap and chroot" >&2; exit 2; }
for suite in "${suites[@]}"; do
  prepare "$suite" || { echo "everywhere: debootstrap $suite failed: $work/$suite.debootstrap.log" >&2; exit 1; }
  for step in "${steps[@]}"; do try "$suite" "$step"; done
done
report | tee out/everywhere.md
