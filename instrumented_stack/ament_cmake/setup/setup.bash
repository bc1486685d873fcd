# SPDX-License-Identifier: Apache-2.0
# Adds the packages beside this file, and what they were built against, to the environment of a bash: source setup.bash
LAUNCH_SETUP_PREFIX=$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)
. "$LAUNCH_SETUP_PREFIX/setup.sh"
