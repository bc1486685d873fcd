# SPDX-License-Identifier: Apache-2.0
# Functions of bash that read packages/table.txt: which system this is, and what it needs. `dev` and packages/on source it.

packages_table=$(dirname "${BASH_SOURCE[0]}")/table.txt

# known_systems: the columns of the table, a line each.
known_systems() {
  awk '$1 == "group" { for (i = 3; i <= NF; ++i) print $i; exit }' "$packages_table"
}

# rows_of GROUP SYSTEM: a line for each row of the group: its probe and the system's name for it. Without a system, or with one
# that is not in the table, the name is `-`.
rows_of() {
  awk -v group="$1" -v wanted="$2" '
    $1 ~ /^#/ || NF == 0 { next }
    $1 == "group" { for (i = 3; i <= NF; ++i) if ($i == wanted) column = i; next }
    $1 == group {
      name = "-"
      if (column) for (i = column; (name = $i) == "="; --i) {}
      print $2, name
    }' "$packages_table"
}

# packages_of GROUP SYSTEM: the names of packages that the system has, a line each.
packages_of() {
  rows_of "$1" "$2" | awk '$2 != "-" { print $2 }'
}

# wanted_packages_of GROUP SYSTEM: those without the ones of programs that may come from elsewhere, and are there.
wanted_packages_of() {
  rows_of "$1" "$2" | awk '$2 != "-"' | while read -r probe name; do
    [[ $probe == found:* ]] && is_there "$probe" || echo "$name"
  done
}

# own_system [OS-RELEASE]: the column of the table for this system, or nothing. Systems that are derived from Debian and Ubuntu
# without names of their own for the packages (Raspberry Pi OS, Mint) say the code name of what they were made of.
own_system() (
  ID='' VERSION_ID='' VERSION_CODENAME='' UBUNTU_CODENAME=''
  . "${1:-/etc/os-release}" 2>/dev/null || return 0
  for system in $(known_systems); do
    if [ "$system" = "$ID:$VERSION_ID" ] || [ "$(packages_of suite "$system")" = "${UBUNTU_CODENAME:-$VERSION_CODENAME}" ]; then
      echo "$system"
      return
    fi
  done
  # Debian's testing and unstable have no number.
  if [ "$ID" = debian ] && [ -z "$VERSION_ID" ]; then
    echo debian:testing
  fi
)

# system_words [OS-RELEASE]: what a person calls this system.
system_words() (
  PRETTY_NAME='' ID=unknown
  . "${1:-/etc/os-release}" 2>/dev/null || true
  echo "${PRETTY_NAME:-$ID}"
)

# is_there PROBE: whether this machine has what the probe asks for. `-` can't be asked.
is_there() {
  local what=${1#*:}
  case $1 in
    program:clang*) compgen -c "$what" >/dev/null ;;  # with any version behind it
    program:* | found:*) command -v "$what" >/dev/null || [ -x "/usr/sbin/$what" ] || [ -x "/sbin/$what" ] ;;
    module:*) pkg-config --exists "$what" 2>/dev/null ;;
    header:*) [ -e "/usr/include/$what" ] || [ -e "/usr/local/include/$what" ] || compgen -G "/usr/include/*-linux-gnu*/$what" >/dev/null ;;
    python:*) python3 -c "import $what" 2>/dev/null ;;
  esac
}

# missing_needs SYSTEM GROUP...: the probes of what neither a package of this system gives nor the machine has.
missing_needs() {
  local system=$1 group probe name
  shift
  for group in "$@"; do
    rows_of "$group" "$system"
  done | sort -u | while read -r probe name; do
    [ "$name" != - ] || is_there "$probe" || echo "$probe"
  done
}

# install_packages NAME...: installs those that are missing, with the system's package manager.
install_packages() {
  local missing=() name
  for name in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { echo "dev: error: not root, and there is no sudo; install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -q >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
}

# libraries_for PROCESSOR: the packages of libraries that a build for another processor links, a line each: `libfmt-dev:arm64`.
# Packages of headers alone are the same for all. Of Python the library is wanted, not a second interpreter.
libraries_for() {
  rows_of build "$(own_system)" | sed -n 's/^\(module\|header\):[^ ]* //p' | grep -v '^-$' | sort -u | while read -r name; do
    [ "$name" != python3-dev ] || name=libpython3-dev
    [ "$(apt-cache show --no-all-versions "$name" | sed -n 's/^Architecture: //p' | head -n 1)" = all ] || echo "$name:$1"
  done
}

# need GROUP...: sees to it that what the groups need is there. On a system that is not in the table it only looks, and the
# command ends if something is missing.
need() {
  local system group names=() missing
  system=$(own_system)
  mapfile -t missing < <(missing_needs "$system" "$@")
  if [ -z "$system" ]; then
    [ ${#missing[@]} -gt 0 ] || return 0
    {
      echo "dev: error: the packages of $(system_words) are not known here, so nothing is installed. This is missing:"
      printf '  %s\n' "${missing[@]}"
      echo "  Debian 12 has it in: $(for group in "$@"; do rows_of "$group" debian:12; done |
        awk 'NR == FNR { wanted[$1]; next } $1 in wanted && !seen[$2]++ { printf "%s%s", separator, $2; separator = " " }' \
          <(printf '%s\n' "${missing[@]}") -)"
      echo "  ./dev on SYSTEM COMMAND builds in a file system of: $(known_systems | paste -sd ' ')"
    } >&2
    exit 1
  fi
  for group in "$@"; do
    mapfile -t -O ${#names[@]} names < <(wanted_packages_of "$group" "$system")
  done
  install_packages "${names[@]}"
  if [ -n "${LAUNCH_CROSS:-}" ]; then
    install_packages "crossbuild-essential-$LAUNCH_CROSS"
    mapfile -t names < <(libraries_for "$LAUNCH_CROSS")
    install_packages "${names[@]}"
  fi
  [ ${#missing[@]} = 0 ] || say "$system has no package for ${missing[*]}"
}

# clang_version: the version of Clang that this system's row of the table names.
clang_version() {
  packages_of lint "$(own_system)" | sed -n 's/^clang-\([0-9]*\)$/\1/p'
}
