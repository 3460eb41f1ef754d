# SPDX-License-Identifier: MIT
# Sourced by ./banyan and ./check: finds out which Debian packages are missing and installs them.
# Everything it says goes to stderr.

# The groups that are features of the program.
banyan_features=(zstd box2d maps pixels fleets tuning figures mpi)

# banyan_packages GROUP...: the names in those groups of packages.txt, one per line.
banyan_packages() {
  local here line group='' name major
  here=$(dirname "${BASH_SOURCE[0]}")
  while IFS= read -r line || [[ -n $line ]]; do
    line=${line%%#*}
    name=${line//[[:space:]]/}
    case $name in
      '') continue ;;
      \[*\]) group=${name:1:-1}; continue ;;
      nodejs | npm)
        major=$(node --version 2>/dev/null | sed -n 's/^v\([0-9]*\)\..*/\1/p')
        if ((${major:-0} >= 18)) && command -v npm >/dev/null; then continue; fi ;;
    esac
    [[ " $* " == *" $group "* ]] && printf '%s\n' "$name"
  done <"$here/packages.txt"
  return 0
}

# banyan_missing GROUP...: those that are not installed.
banyan_missing() {
  local -a wanted
  mapfile -t wanted < <(banyan_packages "$@" | sort -u)
  dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null |
    awk -v wanted="${wanted[*]}" '
      $2 == "installed" { have[$1] = 1 }
      END { n = split(wanted, name, " "); for (i = 1; i <= n; ++i) if (!(name[i] in have)) print name[i] }'
}

# banyan_install PROGRAM LOG GROUP...: installs what is missing. PROGRAM prefixes the messages.
banyan_install() {
  local program=$1 log=$2
  shift 2
  # Elsewhere than on Debian the build itself says what it lacks.
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || return 0
  local -a missing=() command
  mapfile -t missing < <(banyan_missing "$@")
  ((${#missing[@]})) || return 0
  command=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120)
  if ((EUID != 0)); then
    # Without a terminal nobody can type a password.
    if ! command -v sudo >/dev/null || { [[ ! -t 0 ]] && ! sudo -n true 2>/dev/null; }; then
      printf '%s: these packages are missing, and this user cannot install them. As root, run\n  apt-get install --no-install-recommends %s\n' \
        "$program" "${missing[*]}" >&2
      local package
      for package in "${missing[@]}"; do
        sed -n "s/^$package  *# /    $package: /p" "$(dirname "${BASH_SOURCE[0]}")/packages.txt" | head -n 1 >&2
      done
      return 1
    fi
    if [[ -t 0 ]]; then command=(sudo "${command[@]}"); else command=(sudo -n "${command[@]}"); fi
  fi
  printf '%s: installing with apt: %s\n' "$program" "${missing[*]}" >&2
  : >"$log" || return 1
  local -a install=(install -y -q --no-install-recommends "${missing[@]}")
  # The package lists of a fresh machine are empty or old: fetch them only when they are needed.
  if "${command[@]}" "${install[@]}" </dev/null >>"$log" 2>&1; then return 0; fi
  printf '%s: fetching the package lists (apt-get update)\n' "$program" >&2
  # A third-party list that cannot be fetched does not matter if the install then succeeds.
  "${command[@]}" update -q </dev/null >>"$log" 2>&1 || true
  if "${command[@]}" "${install[@]}" </dev/null >>"$log" 2>&1; then return 0; fi
  printf '%s: apt could not install them; the end of %s:\n' "$program" "$log" >&2
  tail -n 20 "$log" >&2
  return 1
}
