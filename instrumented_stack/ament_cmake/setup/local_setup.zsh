# SPDX-License-Identifier: Apache-2.0
# Adds the packages beside this file to the environment of a zsh: source local_setup.zsh
LAUNCH_SETUP_PREFIX=${${(%):-%x}:A:h}
. "$LAUNCH_SETUP_PREFIX/local_setup.sh"
