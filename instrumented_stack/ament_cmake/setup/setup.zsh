# SPDX-License-Identifier: Apache-2.0
# Adds the packages beside this file, and what they were built against, to the environment of a zsh: source setup.zsh
LAUNCH_SETUP_PREFIX=${${(%):-%x}:A:h}
. "$LAUNCH_SETUP_PREFIX/setup.sh"
