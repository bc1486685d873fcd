# SPDX-License-Identifier: Apache-2.0
"""Events of the kernel where LTTng has no modules: launch-kernel-recorder records them through tracefs, as for a <trace>."""

import os
import signal
import subprocess
import time
from pathlib import Path

PATIENCE_S = 20


class KernelRecorderError(Exception):
    """Events of the kernel cannot be recorded through tracefs either; the message says why."""


class KernelRecorder:
    """Records beside a session that writes to `directory`. Paused at first."""

    def __init__(self, program, name, directory, events):
        self._state = Path(directory) / 'kernel-recorder.pid'
        Path(directory).mkdir(parents=True, exist_ok=True)
        arguments = [word for event in events for word in ('event', event, '')]
        try:
            self._process = subprocess.Popen((program, name, str(Path(directory) / 'kernel'), *arguments),
                                             stdout=subprocess.PIPE, text=True)
        except OSError as error:
            raise KernelRecorderError(str(error)) from None
        said = self._process.stdout.read().splitlines()  # it closes its output when it records
        if said[:1] != ['ready'] or len(said) > 1:
            self.close()
            raise KernelRecorderError(' '.join(said) or 'the kernel recorder says nothing')
        self.stop()

    def _ask(self, number, state):
        """The recorder names its state in a file, which it replaces."""
        self._process.send_signal(number)
        deadline = time.monotonic() + PATIENCE_S
        while self._state.read_text().split(maxsplit=2)[2].strip() != state:
            if time.monotonic() > deadline:
                raise KernelRecorderError(f'the kernel recorder is not {state} after {PATIENCE_S} s')
            os.sched_yield()

    def start(self):
        self._ask(signal.SIGUSR2, 'recording')

    def stop(self):
        self._ask(signal.SIGUSR1, 'paused')

    def close(self):
        self._process.terminate()
        self._process.wait()
        self._process.stdout.close()
