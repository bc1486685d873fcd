# SPDX-License-Identifier: Apache-2.0
"""
Settings that make latencies steady: real-time priority, pinning, frequency, idle states.

Each is set where the machine permits it, put back at the end, and described in the result either way.
"""

import glob
import os
import struct
from dataclasses import dataclass
from pathlib import Path

PRIORITY = 99  # SCHED_FIFO, as in the paper


@dataclass(frozen=True)
class Setting:
    """What was wanted of the machine, and what it is."""

    name: str
    state: str   # 'set', 'as found', 'refused', 'absent'
    detail: str


def _read(path):
    try:
        return Path(path).read_text().strip()
    except OSError:
        return None


class Tuning:
    """Applies the settings in its scope. `settings` describes them."""

    def __init__(self, real_time=True):
        self.processors = sorted(os.sched_getaffinity(0))
        self._restore = []
        self._latency_request = None
        self.real_time = real_time and self._may_be_real_time()
        self.settings = [
            self._priority(real_time),
            Setting('processors', 'set', 'publisher on %d, subscriber on %d' % (self.processors[0],
                    self.processors[1 % len(self.processors)])),
            self._idle_states(),
            self._frequency(),
            self._turbo(),
            self._threads_of_a_core(),
            Setting('network buffers', 'as found', f"net.core.rmem_max {_read('/proc/sys/net/core/rmem_max')}, "
                    'not used: messages pass through shared memory'),
        ]

    def prepare_child(self, processor):
        """In a child, before its program starts: its processor and its priority, which its threads inherit."""
        os.sched_setaffinity(0, {self.processors[processor % len(self.processors)]})
        if self.real_time:
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))

    def _may_be_real_time(self):
        child = os.fork()
        if child == 0:
            try:
                os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
            except OSError:
                os._exit(1)
            os._exit(0)
        return os.waitpid(child, 0)[1] == 0

    def _priority(self, wanted):
        if self.real_time:
            return Setting('real-time priority', 'set', f'SCHED_FIFO {PRIORITY} for all threads of the measured programs')
        return Setting('real-time priority', 'refused' if wanted else 'as found', 'SCHED_OTHER')

    def _idle_states(self):
        driver = _read('/sys/devices/system/cpu/cpuidle/current_driver') or 'none'
        governor = _read('/sys/devices/system/cpu/cpuidle/current_governor') or 'none'
        found = f'driver {driver}, governor {governor}'
        if driver == 'haltpoll':
            found += ' (a guest that polls before it halts)'
        try:
            request = os.open('/dev/cpu_dma_latency', os.O_WRONLY | os.O_CLOEXEC)
            os.write(request, struct.pack('i', 0))
        except OSError as error:
            return Setting('idle states', 'refused', f'{found}; /dev/cpu_dma_latency: {error.strerror}')
        self._latency_request = request  # counts while it is open
        return Setting('idle states', 'set', f'{found}; a wake-up latency of 0 is asked for')

    def _write(self, name, paths, value, detail):
        before = {path: _read(path) for path in paths}
        try:
            for path in paths:
                Path(path).write_text(value)
                self._restore.append((path, before[path]))
        except OSError as error:
            return Setting(name, 'refused', f'{before[paths[0]]}; {error.strerror}')
        return Setting(name, 'set', detail)

    def _frequency(self):
        paths = sorted(glob.glob('/sys/devices/system/cpu/cpu[0-9]*/cpufreq/scaling_governor'))
        if not paths:
            return Setting('frequency', 'absent', 'the machine has no control of it')
        return self._write('frequency', paths, 'performance', 'governor performance')

    def _turbo(self):
        for path, off in (('/sys/devices/system/cpu/intel_pstate/no_turbo', '1'),
                          ('/sys/devices/system/cpu/cpufreq/boost', '0')):
            if os.path.exists(path):
                return self._write('turbo', [path], off, 'off')
        return Setting('turbo', 'absent', 'the machine has no control of it')

    def _threads_of_a_core(self):
        state = _read('/sys/devices/system/cpu/smt/control')
        active = _read('/sys/devices/system/cpu/smt/active')
        if state is None:
            return Setting('threads of a core', 'absent', 'the machine does not say')
        return Setting('threads of a core', 'as found', f"{state}, {'in use' if active == '1' else 'not in use'}")

    def close(self):
        for path, value in reversed(self._restore):
            Path(path).write_text(value)
        if self._latency_request is not None:
            os.close(self._latency_request)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
