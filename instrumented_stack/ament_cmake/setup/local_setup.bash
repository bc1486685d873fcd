# SPDX-License-Identifier: Apache-2.0
# Adds the packages beside this file to the environment of a bash: source local_setup.bash
LAUNCH_SETUP_PREFIX=$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
. "$LAUNCH_SETUP_PREFIX/local_setup.sh"
