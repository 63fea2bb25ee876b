#!/usr/bin/env bash
# ./dev on systems that are not here: their package managers are scripts in an otherwise empty PATH.
# usage: packages.sh <source directory>
set -euo pipefail
cd "$1"
unset DSPM_INSTALL  # ./dev test may have been called with it
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for tool in awk bash cat cut dirname env grep head printf sed sort tr; do ln -s "$(command -v $tool)" "$work/$tool"; done
failures=0

fake() {  # name, commands
  printf '#!%s\n%s\n' "$(command -v bash)" "$2" >"$work/$1"
  chmod +x "$work/$1"
}

dev() {  # purposes: as ./dev sees to them; prints what it says, and its exit code
  PATH=$work bash -c 'set -euo pipefail; stop() { echo "dev: $1"; exit "${2:-1}"; }; . tools/packages.sh; need "$@"' dev "$@" 2>&1 ||
    echo "exit code $?"
}

says() {  # text, what it must hold...
  local said=$1 wanted
  shift
  for wanted; do
    [[ $said == *"$wanted"* ]] || { printf 'FAILED: no "%s" in:\n%s\n' "$wanted" "$said"; failures=$((failures + 1)); }
  done
}

# Without a manager that it knows: the names of all four.
says "$(dev build)" "by the names of apt: g++ cmake" "of dnf: gcc-c++ cmake" "of pacman: gcc cmake" "of brew: gcc cmake" \
  "DSPM_INSTALL=no ./dev" "exit code 2"
says "[$(DSPM_INSTALL=no dev build)]" "[]"

# Fedora, with a compiler: what is missing, in one command.
fake dnf ''
fake rpm '[[ $* == *gcc-c++ || $* == *" cmake" ]]'
said=$(dev build)
says "$said" "sudo dnf install ninja-build tbb-devel embree-devel" "exit code 2"
[[ $said != *gcc-c++* ]] || says "$said" "no compiler that is there"
rm "$work/dnf" "$work/rpm"

# Bare Debian: everything is installed, by one command. One package that tests would need is not there, and is named.
fake dpkg-query 'exit 1'
fake apt-get '[[ $1 == install ]] && echo "$@" >&2 || true'
fake id 'echo 0'
fake sudo '"$@"'
fake apt-cache 'for each in "${@:2}"; do [[ $each == zstd ]] || printf "%s:\n  Installed: (none)\n  Candidate: 4:2099.1-1\n" $each; done'
said=$(dev build extra test)
says "$said" "dev: installing g++ cmake ninja-build" "libmeshoptimizer-dev libnanovdb-dev libopenvdb-dev clang" "apt has no zstd" "--no-install-recommends"
[[ $said != *"exit code"* ]] || says "$said" "no failure"

# Ubuntu 22.04: package by package, and nothing is installed.
fake apt-cache 'declare -A old=([g++]=4:11.2.0-1ubuntu1 [cmake]=3.22.1-1ubuntu1 [libopenexr-dev]=2.5.7-1)
  for each in "${@:2}"; do [[ $each == libcli11-dev ]] || printf "%s:\n  Candidate: %s\n" $each "${old[$each]:-2099.1}"; done'
said=$(dev build)
says "$said" "g++: 11.2.0-1ubuntu1, older than the 12 " "cmake: 3.22.1" "libopenexr-dev: 2.5.7-1, older than the 3.1 " \
  "libcli11-dev: there is no such package" "CXX=" "exit code 2"
[[ $said != *installing* ]] || says "$said" "nothing installed"
said=$(CXX=g++-12 dev build)
[[ $said != *"g++: 11"* ]] || says "$said" "another compiler taken"

# All is there: nothing is said.
fake dpkg-query 'for each in "${@:4}"; do echo "installed $each"; done'
says "[$(dev build extra test)]" "[]"
exit $((failures > 0))
