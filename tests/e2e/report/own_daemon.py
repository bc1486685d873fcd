# SPDX-License-Identifier: Apache-2.0
"""A session daemon of a test's own: a trace holds what all processes fire that its daemon knows, also those of tests beside."""

import os

# Put it before the words of a command. Root's daemon does not look at LTTNG_HOME, so it gets a /run/lttng of its own; the
# daemons end with the command. Others set LTTNG_HOME.
OWN_DAEMON = () if os.geteuid() != 0 else (
    'unshare', '--mount', '--pid', '--fork', '--kill-child', '--mount-proc', '--propagation', 'private', 'bash', '-c',
    'mkdir -p /run/lttng && mount -t tmpfs tmpfs /run/lttng && "$@"; exit $?', 'own_daemon')
