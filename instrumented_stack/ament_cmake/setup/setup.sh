# SPDX-License-Identifier: Apache-2.0
# Adds the prefixes that the packages beside this file were built against, then these packages: source it from setup.bash
# or setup.zsh. In another shell, set LAUNCH_SETUP_PREFIX to the folder of this file before.
if [ -n "${LAUNCH_SETUP_PREFIX-}" ] && [ -e "$LAUNCH_SETUP_PREFIX/underlays" ]; then
  _launch_setup_here="$LAUNCH_SETUP_PREFIX"
  _launch_setup_below=
  while IFS= read -r _launch_setup_underlay; do
    # The last one is below all others.
    _launch_setup_below="$_launch_setup_underlay
$_launch_setup_below"
  done <"$_launch_setup_here/underlays"
  while IFS= read -r _launch_setup_underlay; do
    if [ -e "$_launch_setup_underlay/local_setup.sh" ]; then
      LAUNCH_SETUP_PREFIX="$_launch_setup_underlay" AMENT_CURRENT_PREFIX="$_launch_setup_underlay"
      . "$_launch_setup_underlay/local_setup.sh"
    fi
  done <<LAUNCH_SETUP_END
$_launch_setup_below
LAUNCH_SETUP_END
  LAUNCH_SETUP_PREFIX="$_launch_setup_here"
  unset _launch_setup_here _launch_setup_below _launch_setup_underlay AMENT_CURRENT_PREFIX
fi
. "${LAUNCH_SETUP_PREFIX:-.}/local_setup.sh"
