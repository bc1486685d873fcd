# SPDX-License-Identifier: Apache-2.0
"""The machine on which something was measured, and whether it had other work meanwhile."""

import os
import platform
import time
from pathlib import Path

BUSY = 0.10   # of a processor, used by others
STOLEN = 0.01  # of the processors, taken by the host


def _lines(path):
    try:
        return Path(path).read_text().splitlines()
    except OSError:
        return []


def _value(path, name):
    return next((line.split(':', 1)[1].strip() for line in _lines(path) if line.startswith(name)), None)


def description():
    """What the machine is."""
    flags = (_value('/proc/cpuinfo', 'flags') or '').split()
    return {
        'processor': _value('/proc/cpuinfo', 'model name') or platform.machine(),
        'processors': os.cpu_count(),
        'usable_processors': len(os.sched_getaffinity(0)),
        'mhz': float(_value('/proc/cpuinfo', 'cpu MHz') or 0),
        'cache': _value('/proc/cpuinfo', 'cache size'),
        'memory_mib': int((_value('/proc/meminfo', 'MemTotal') or '0').split()[0]) // 1024,
        'virtual': 'hypervisor' in flags,
        'kernel': platform.release(),
        'kernel_version': platform.version(),
        'real_time_kernel': 'PREEMPT_RT' in platform.version(),
        'clock_source': ''.join(_lines('/sys/devices/system/clocksource/clocksource0/current_clocksource')),
        'load_before': [round(value, 2) for value in os.getloadavg()],
    }


def build_of(tree):
    """How the measured programs were built, or None if the tree does not say."""
    values = dict(line.split('=', 1) for line in _lines(tree / 'CMakeCache.txt') if '=' in line and not line.startswith(('#', '//')))
    values = {name.split(':')[0]: value for name, value in values.items()}
    kind = values.get('CMAKE_BUILD_TYPE')
    if not kind:
        return None
    joined = ', several sources compiled as one' if values.get('CMAKE_UNITY_BUILD') == 'ON' else ''
    return f"{kind}, {values.get('CMAKE_CXX_FLAGS_' + kind.upper(), '')}{joined}"


class Jiffies:
    """Processor time of the whole machine at a moment, in seconds: used, stolen, and that of this program."""

    def __init__(self, stat=None, own=None):
        ticks = os.sysconf('SC_CLK_TCK')
        fields = [int(value) / ticks for value in (stat or _lines('/proc/stat')[0]).split()[1:]]
        user, nice, system, _idle, _wait, irq, soft_irq, stolen = fields[:8]
        self.used = user + nice + system + irq + soft_irq
        self.stolen = stolen
        times = os.times()
        self.own = own if own is not None else (times.user + times.system + times.children_user
                                                + times.children_system)
        self.at = time.monotonic()


def use_between(begin, end, processors):
    """The shares of processor time that the host took, and that others used (of one processor)."""
    seconds = max(end.at - begin.at, 1e-9)
    others = (end.used - begin.used) - (end.own - begin.own)
    return {'seconds': round(seconds, 1), 'stolen': round(max(0.0, end.stolen - begin.stolen) / seconds / processors, 4),
            'others': round(max(0.0, others) / seconds, 3)}


def warnings_of(use, when):
    """What a reader of the figures must know."""
    warnings = []
    if use['others'] > BUSY:
        warnings.append(f"The machine was busy {when}: other programs used {100 * use['others']:.0f} % of a processor. "
                        'The figures are those of a busy machine.')
    if use['stolen'] > STOLEN:
        warnings.append(f"The host took {100 * use['stolen']:.1f} % of the processors away {when}.")
    return warnings


def idle_check(seconds=1.0):
    """Watches for a moment whether others use the machine, before anything is started."""
    begin = Jiffies()
    time.sleep(seconds)
    return use_between(begin, Jiffies(), os.cpu_count())
