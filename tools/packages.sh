# What ./dev needs of the system: looks up the rows of packages.txt and installs what is missing, or says what to install.
# For ./dev to read; it has `stop`.

managers=(apt dnf pacman brew)

# "package oldest" of each row for these purposes that the manager has a package for.
rows() {  # manager, purposes
  awk -v manager="$1" -v purposes=" ${*:2} " '
    $1 == "#" && $2 == "for" { for (i = 2; i <= NF; ++i) if ($i == manager) column = i - 1 }
    $1 ~ /^#/ || !column || $column == "-" { next }
    {
      count = split($1, purpose, ",")
      for (i = 1; i <= count; ++i) if (index(purposes, " " purpose[i] " ") && !seen[$column]++) print $column, $2
    }
  ' tools/packages.txt
}

packages() {  # manager, purposes
  rows "$@" | cut -d ' ' -f 1
}

manager_here() {
  local manager
  for manager in "${managers[@]}"; do
    if command -v "${manager/#apt/apt-get}" >/dev/null; then
      echo "$manager"
      return
    fi
  done
}

installed() {  # manager, packages
  local package
  case $1 in
    apt) dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${@:2}" 2>/dev/null | sed -n 's/^installed //p' ;;
    dnf) for package in "${@:2}"; do ! rpm -q --quiet --whatprovides "$package" || echo "$package"; done ;;
    pacman) pacman -Qq "${@:2}" 2>/dev/null ;;
    brew) brew list --versions "${@:2}" 2>/dev/null | cut -d ' ' -f 1 ;;
  esac || true
}

# "package version" of those that apt has.
on_offer() {  # packages
  apt-cache policy "$@" 2>/dev/null |
    awk '/^[^ ]/ { sub(/:$/, ""); package = $0 } $1 == "Candidate:" && $2 != "(none)" { sub(/^[0-9]+:/, "", $2); print package, $2 }'
}

is_older() {  # version, than
  [[ $2 != - && $(printf '%s\n' "$1" "$2" | sort -V | head -n 1) != "$2" ]]
}

# The lines of two lists whose first words are the same, put together; "none" if the second list lacks one.
beside() {  # lines, lines
  awk 'NR == FNR { of[$1] = $2; next } { print $0, ($1 in of ? of[$1] : "none") }' <(echo "$2") <(echo "$1")
}

# Stops if apt has not, or only in an old version, what building needs.
refuse_old() {  # lines "package oldest version"
  local package oldest version wrong=()
  while read -r package oldest version; do
    [[ $package == g++ && ${CXX:-g++} != g++ ]] && continue
    if [[ $version == none ]]; then
      wrong+=("$package: there is no such package")
    elif is_older "$version" "$oldest"; then
      wrong+=("$package: $version, older than the $oldest that dspm was tried with")
    fi
  done
  [[ ${#wrong[@]} -eq 0 ]] && return
  echo "dev: dspm does not build from this system's packages alone:" >&2
  printf '  %s\n' "${wrong[@]}" >&2
  echo "dev: with a newer compiler in place: CXX=g++-13 ./dev ...; with newer libraries in place: DSPM_INSTALL=no ./dev ..." >&2
  stop "docs/building.md has what several systems lack" 2
}

# What to install, where ./dev does not install.
advise() {  # manager, missing packages
  local manager
  echo "dev: needed, and not installed here:" >&2
  case $1 in
    dnf) echo "  sudo dnf install ${*:2}" >&2 ;;
    pacman) echo "  sudo pacman -S --needed ${*:2}" >&2 ;;
    brew) echo "  brew install ${*:2}" >&2 ;;
    *)
      for manager in "${managers[@]}"; do
        echo "  by the names of $manager: $(packages "$manager" "${purposes[@]}" | tr '\n' ' ')" >&2
      done ;;
  esac
  stop "then run this again; with the like of them in place: DSPM_INSTALL=no ./dev ..." 2
}

as_root() {
  local as=(env DEBIAN_FRONTEND=noninteractive)
  [[ $EUID -eq 0 ]] || as=(sudo "${as[@]}")
  "${as[@]}" "$@"
}

install_with_apt() {  # missing packages
  local known
  [[ $EUID -eq 0 ]] || command -v sudo >/dev/null || stop "to be installed by root first: apt-get install $*" 2
  as_root apt-get update -qq
  refuse_old < <(beside "$(rows apt build)" "$(on_offer $(packages apt build))")
  mapfile -t known < <(on_offer "$@" | cut -d ' ' -f 1)
  (($# == ${#known[@]})) || echo "dev: apt has no $(printf '%s\n' "$@" | grep -vxF "$(printf '%s\n' "${known[@]}")" | tr '\n' ' ')" >&2
  ((${#known[@]})) || return 0
  echo "dev: installing ${known[*]}"
  as_root apt-get install -qq --no-install-recommends -o Dpkg::Use-Pty=0 "${known[@]}" >/dev/null
}

# Sees to it that what these purposes need is installed.
need() {  # purposes: rows of packages.txt
  [[ ${DSPM_INSTALL:-yes} == no ]] && return
  local purposes=("$@") manager wanted missing
  manager=$(manager_here)
  mapfile -t wanted < <(packages "${manager:-apt}" "${purposes[@]}")
  mapfile -t missing < <(printf '%s\n' "${wanted[@]}" | grep -vxF -e "$(installed "$manager" "${wanted[@]}")")
  [[ ${#missing[@]} -eq 0 ]] && return
  case $manager in
    apt) install_with_apt "${missing[@]}" ;;
    *) advise "${manager:-none}" "${missing[@]}" ;;
  esac
}
