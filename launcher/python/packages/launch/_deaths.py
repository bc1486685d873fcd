# SPDX-License-Identifier: Apache-2.0
"""Tells where Python is when it ends the process in which it runs launch files."""

import faulthandler
import os
import posix


def report(descriptor):
    """From now on a signal that kills, and os._exit(), write the stack into the descriptor."""
    faulthandler.enable(descriptor, all_threads=False)
    process, leave = os.getpid(), os._exit

    def _exit(status):
        if os.getpid() == process:  # and not a child that os.fork() made
            faulthandler.dump_traceback(descriptor, all_threads=False)
        leave(status)

    os._exit = posix._exit = _exit
