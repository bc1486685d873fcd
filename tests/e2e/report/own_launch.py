# SPDX-License-Identifier: Apache-2.0
"""
Runs launches with a session daemon of their own. A trace holds what all processes fire that its daemon knows, so with the
machine's daemon it would also hold what tests beside fire.
"""

import os
import re
import subprocess

PATIENCE = 120  # seconds
STARTED = re.compile(r'process started with pid \[(\d+)\]')

# Root's daemon does not look at LTTNG_HOME, so root gets a /run/lttng of its own. The daemons end with the command: they are killed,
# so what they have told programs in /dev/shm stays, and programs of the next test would look for them for seconds.
IS_ROOT = os.geteuid() == 0
NAMESPACES = ('unshare', '--mount', '--pid', '--fork', '--kill-child', '--mount-proc', '--propagation', 'private')
OWN_DIRECTORY = 'mkdir -p /run/lttng && mount -t tmpfs tmpfs /run/lttng && mount -t tmpfs tmpfs /dev/shm || exit 1; '


def launch(directory, *words, code=0, times=1):
    """
    Runs `launch` with these words, its home in the directory and its traces in `traces` there. Returns the process. With
    `times` it runs so often, one after the other; each launch must succeed but the last. No two processes have the same id.
    """
    script = (OWN_DIRECTORY if IS_ROOT else '') + f'for run in $(seq {times}); do "$@" || exit $?; done'
    return run(directory, [*(NAMESPACES if IS_ROOT else ()), 'bash', '-c', script], words, code)


def launch_on_hosts(directory, hosts, *words):
    """
    Runs the launch on several hosts at once, which have a network in common and nothing else. `host` is set to the name.
    Processes of two hosts do not have the same id. Needs root.
    """
    (directory / 'traces').mkdir(exist_ok=True)  # a daemon fails if another one makes the directory at the same time
    host = 'hostname "$0" && ' + OWN_DIRECTORY + 'exec "$@" "host:=$0"'
    script = (f'ip link set lo up; for host in {" ".join(hosts)}; do unshare --uts --mount bash -c \'{host}\' $host "$@" '
              '& children="$children $!"; done; for child in $children; do wait $child || code=$?; done; exit $code')
    return run(directory, [*NAMESPACES, 'unshare', '--net', 'bash', '-c', script], words, 0)


def run(directory, before, words, code):
    environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
    environment.update(ROS_HOME=str(directory), ROS_TRACE_DIR=str(directory / 'traces'), LTTNG_HOME=str(directory))
    done = subprocess.run([*before, 'own_launch', os.environ['LAUNCH_PROGRAM'], *words], env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE)
    assert done.returncode == code, (done.returncode, done.stdout, done.stderr)
    return done


def started(run):
    """The ids of the processes that the launch has started."""
    return {int(pid) for pid in STARTED.findall(run.stdout + run.stderr)}
