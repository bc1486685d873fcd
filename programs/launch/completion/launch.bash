# SPDX-License-Identifier: Apache-2.0
# Completion of launch(1) for bash.
_launch() {
  local line=${COMP_LINE:0:COMP_POINT} words current prefix
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  current=${words[${#words[@]} - 1]}
  mapfile -t COMPREPLY <<<"$("${words[0]}" complete "${words[@]:1}" 2>/dev/null)"
  [[ -n ${COMPREPLY[0]} ]] || COMPREPLY=()
  # bash breaks words at ':' and '=', and wants only what comes after the last of them.
  prefix=${current%"${current##*[:=]}"}
  COMPREPLY=("${COMPREPLY[@]#"$prefix"}")
  if [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *[=/] ]]; then
    compopt -o nospace 2>/dev/null
  fi
}
complete -o default -F _launch launch
