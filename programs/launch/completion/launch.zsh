#compdef launch
# SPDX-License-Identifier: Apache-2.0
# Completion of launch(1) for zsh.
local -a candidates
candidates=("${(@f)$($words[1] complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
if [[ -z $candidates[1] ]]; then
  _files
  return
fi
# No space behind "rate:=" and "demo/".
compadd -S '' -- ${(M)candidates:#*[=/]}
compadd -- ${candidates:#*[=/]}
