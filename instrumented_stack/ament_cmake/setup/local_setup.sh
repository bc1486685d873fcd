# SPDX-License-Identifier: Apache-2.0
# Adds the packages beside this file to the environment: source it from local_setup.bash or local_setup.zsh. In another
# shell, set LAUNCH_SETUP_PREFIX to the folder of this file before.
#
# The folder is a prefix, or holds a prefix for each package. LD_LIBRARY_PATH is not set, because programs know where
# their libraries are.
if [ -z "${LAUNCH_SETUP_PREFIX-}" ] || [ ! -e "$LAUNCH_SETUP_PREFIX/local_setup.sh" ]; then
  echo "local_setup.sh: set LAUNCH_SETUP_PREFIX to its folder, or source local_setup.bash or local_setup.zsh" >&2
  return 1
fi

_launch_setup_prepend() { # VARIABLE DIRECTORY
  eval "_launch_setup_value=\"\${$1-}\""
  case ":$_launch_setup_value:" in
    *":$2:"*) ;;
    *) eval "export $1=\"\$2\${_launch_setup_value:+:\$_launch_setup_value}\"" ;;
  esac
  unset _launch_setup_value
}

# Does what a line of a .dsv file says: prepend-non-duplicate;VARIABLE;PATH…, set;VARIABLE;VALUE and so on.
_launch_setup_line() { # PREFIX KIND VARIABLE VALUE
  case "$4" in
    /*) _launch_setup_path="$4" ;;
    "") _launch_setup_path="$1" ;;
    *) _launch_setup_path="$1/$4" ;;
  esac
  case "$2" in
    prepend-non-duplicate) _launch_setup_prepend "$3" "$_launch_setup_path" ;;
    prepend-non-duplicate-if-exists) [ ! -e "$_launch_setup_path" ] || _launch_setup_prepend "$3" "$_launch_setup_path" ;;
    set) [ -e "$_launch_setup_path" ] || _launch_setup_path="$4"; eval "export $3=\"\$_launch_setup_path\"" ;;
    set-if-unset) eval "[ -n \"\${$3-}\" ] || export $3=\"\$4\"" ;;
  esac
  unset _launch_setup_path
}

_launch_setup_add() { # PREFIX
  if [ -n "${ZSH_VERSION-}" ]; then emulate -L sh; fi
  _launch_setup_prepend AMENT_PREFIX_PATH "$1"
  _launch_setup_prepend CMAKE_PREFIX_PATH "$1"
  if [ -d "$1/bin" ]; then _launch_setup_prepend PATH "$1/bin"; fi
  for _launch_setup_file in "$1"/lib/python3*/site-packages; do
    if [ -d "$_launch_setup_file" ]; then _launch_setup_prepend PYTHONPATH "$_launch_setup_file"; fi
  done
  # What packages have installed with ament_environment_hooks().
  for _launch_setup_file in "$1"/share/*/environment/*; do
    case "$_launch_setup_file" in
      *.sh) if [ -e "$_launch_setup_file" ]; then AMENT_CURRENT_PREFIX="$1"; . "$_launch_setup_file"; fi ;;
      *.dsv)
        if [ -e "${_launch_setup_file%.dsv}.sh" ]; then continue; fi
        while IFS=';' read -r _launch_setup_kind _launch_setup_variable _launch_setup_value2 || [ -n "$_launch_setup_kind" ]; do
          _launch_setup_line "$1" "$_launch_setup_kind" "$_launch_setup_variable" "$_launch_setup_value2"
        done <"$_launch_setup_file"
        unset _launch_setup_kind _launch_setup_variable _launch_setup_value2
        ;;
    esac
  done
  unset _launch_setup_file AMENT_CURRENT_PREFIX
}

_launch_setup_all() {
  if [ -n "${ZSH_VERSION-}" ]; then emulate -L sh; fi
  if [ -d "$LAUNCH_SETUP_PREFIX/share/ament_index" ]; then _launch_setup_add "$LAUNCH_SETUP_PREFIX"; fi
  for _launch_setup_package in "$LAUNCH_SETUP_PREFIX"/*/share/ament_index; do
    if [ -d "$_launch_setup_package" ]; then _launch_setup_add "${_launch_setup_package%/share/ament_index}"; fi
  done
  unset _launch_setup_package
}

# The packages of ROS 2 that this stack stands in for are those of Jazzy. Another ROS 2 that is sourced already stays.
export ROS_VERSION=2 ROS_PYTHON_VERSION=3 ROS_DISTRO="${ROS_DISTRO:-jazzy}"
_launch_setup_all
unset -f _launch_setup_all _launch_setup_add _launch_setup_line _launch_setup_prepend
unset LAUNCH_SETUP_PREFIX
