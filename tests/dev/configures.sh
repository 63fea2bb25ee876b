#!/usr/bin/env bash
# Configures the project as `./dev demo` does: without unity builds, which the tests usually have.
# usage: configures.sh <source directory>
set -euo pipefail
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
cmake -S "$1" --preset release -B "$build" >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
