# SPDX-License-Identifier: MIT
# bash completion for the banyan command. Try it:   source cli/completion/banyan.bash
# Commands, options and keys are asked from the program itself, so they never go stale. Without a
# built program (./banyan builds it first) there are only file names.

# The program behind the word that was typed: the wrapper script builds before it runs, and a
# completion must not.
_banyan_program() {
  local word=$1 here
  if [[ $word == */* && -x ${word%/*}/build/release/bin/banyan ]]; then
    printf '%s' "${word%/*}/build/release/bin/banyan"
  elif here=$(type -P -- "$word"); then
    [[ -x ${here%/*}/build/release/bin/banyan ]] && here=${here%/*}/build/release/bin/banyan
    # A script is the wrapper of a house that has not been built.
    [[ $(head -c 2 -- "$here" 2>/dev/null | tr -d '\0') != '#!' ]] && printf '%s' "$here"
  fi
}

_banyan() {
  local current previous command='' program i
  COMPREPLY=()
  # "a=b" arrives as three words because '=' breaks words: put it together again.
  local line=${COMP_LINE:0:COMP_POINT}
  current=${line##* }
  local -a words
  read -r -a words <<<"$line"
  [[ $line == *' ' ]] && words+=('')
  previous=${words[${#words[@]} - 2]}
  program=$(_banyan_program "${words[0]}")
  for ((i = 1; i < ${#words[@]} - 1; ++i)); do
    [[ ${words[i]} != -* ]] && { command=${words[i]}; break; }
  done

  local -a candidates=()
  if [[ -n $program ]]; then
    if [[ $previous == --set || $previous == -s ]]; then
      mapfile -t candidates < <("$program" complete-keys -- "$current" 2>/dev/null)
    elif [[ -z $command ]]; then
      mapfile -t candidates < <(compgen -W "$("$program" --help 2>/dev/null |
        sed -n '/^Commands:/,/^$/s/^  \([a-z]\+\) .*/\1/p') --help --version" -- "$current")
    elif [[ $current == -* ]]; then
      mapfile -t candidates < <(compgen -W "$("$program" "$command" --help 2>/dev/null |
        grep -o -- '--[a-z][a-z-]*' | sort -u)" -- "$current")
    elif [[ $command == algorithms ]]; then
      mapfile -t candidates < <(compgen -W "$("$program" complete-keys -- mission.algorithm= 2>/dev/null |
        sed 's/.*=//')" -- "$current")
    elif [[ $command == keys ]]; then
      mapfile -t candidates < <("$program" complete-keys -- "$current" 2>/dev/null | sed 's/=$//')
    fi
  fi
  if ((${#candidates[@]} == 0)) && [[ $current != -* && $previous != --set && $previous != -s ]]; then
    local suffix
    case $command in
      run | validate | hub | fleet | argos) suffix='toml|json' ;;
      export | draw | film) suffix='mcap' ;;
      view) suffix='mcap|part|toml|json' ;;
      *) suffix='' ;;
    esac
    [[ $previous == -o || $previous == --output || $previous == --out ]] && suffix=''
    local file
    while IFS= read -r file; do
      if [[ -d $file ]]; then candidates+=("$file/")
      elif [[ -z $suffix || $file =~ \.($suffix)$ ]]; then candidates+=("$file")
      fi
    done < <(compgen -f -- "$current")
  fi

  # readline replaces only what follows the last '=' (or '[', ']').
  local kept=${current%"${current##*[=:]}"}
  COMPREPLY=("${candidates[@]#"$kept"}")
  if ((${#COMPREPLY[@]} == 1)) && [[ ${COMPREPLY[0]} == *[=/.] ]]; then compopt -o nospace 2>/dev/null; fi
  return 0
}
complete -F _banyan banyan ./banyan
