# SPDX-License-Identifier: Apache-2.0
"""LTTng sessions that the evaluation switches on and off."""

import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

from .kernel import KernelRecorder, KernelRecorderError


class SessionError(Exception):
    """LTTng has refused something; the message is its own."""


@dataclass(frozen=True)
class SessionPlan:
    """What a session records, and how."""

    name: str
    events: tuple = ('ros2:*',)
    contexts: tuple = ()
    buffers: str = 'uid'      # or 'pid'
    subbuffer_size: str = '1M'
    subbuffers: int = 4
    read_timer_us: int = 50_000
    output: str = 'disk'      # or 'network', 'live'
    kernel_events: tuple = ()


# That of the paper: all events, no contexts, buffers for each process.
PAPER = SessionPlan('paper', buffers='pid', subbuffer_size='2M', subbuffers=2, read_timer_us=200_000)
# What a <trace> records by default.
DEFAULT = SessionPlan('default', contexts=('vpid', 'vtid', 'procname'))
PLANS = {plan.name: plan for plan in (PAPER, DEFAULT)}


def lttng(*arguments):
    """Runs the command `lttng` and returns what it prints."""
    done = subprocess.run(('lttng', *arguments), capture_output=True, text=True)
    if done.returncode != 0:
        reason = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise SessionError(f"lttng {' '.join(arguments)}: {reason[-1] if reason else 'it gives no reason'}")
    return done.stdout


class Session:
    """
    A session of a plan, stopped at first. It writes to a directory that is removed with it.

    Events of the kernel go through LTTng's modules if they are there, else through the program `kernel_recorder`.
    """

    def __init__(self, plan, directory, kernel_recorder=None):
        self.plan = plan
        self.through_tracefs = False
        self._kernel_recorder_program = kernel_recorder
        self._kernel_recorder = None
        self.directory = Path(directory) / plan.name
        self._name = f'evaluate-{plan.name}'
        self._running = False
        output = {'disk': ('--output', str(self.directory)),
                  'network': ('--set-url', 'net://127.0.0.1'),
                  'live': ('--live', '--set-url', 'net://127.0.0.1')}[plan.output]
        lttng('create', self._name, *output)
        try:
            self._enable(plan)
        except (SessionError, KernelRecorderError):
            self.close()
            raise

    def _enable(self, plan):
        lttng('enable-channel', '-u', 'ros2', '-s', self._name, f'--buffers-{plan.buffers}', '--discard',
              f'--num-subbuf={plan.subbuffers}', f'--subbuf-size={plan.subbuffer_size}',
              f'--read-timer={plan.read_timer_us}', '--monitor-timer=0')
        if plan.contexts:
            lttng('add-context', '-u', '-s', self._name, '-c', 'ros2',
                  *(word for context in plan.contexts for word in ('-t', context)))
        lttng('enable-event', '-u', '-s', self._name, '-c', 'ros2', ','.join(plan.events))
        if plan.kernel_events:
            self._enable_kernel(plan)

    def _enable_kernel(self, plan):
        try:
            lttng('enable-channel', '-k', 'kernel', '-s', self._name, '--num-subbuf=8', '--subbuf-size=1M')
            lttng('enable-event', '-k', '-s', self._name, '-c', 'kernel', ','.join(plan.kernel_events))
        except SessionError:
            if self._kernel_recorder_program is None:
                raise
            self._kernel_recorder = KernelRecorder(self._kernel_recorder_program, self._name, self.directory,
                                                   plan.kernel_events)
            self.through_tracefs = True

    def start(self):
        if self._kernel_recorder:
            self._kernel_recorder.start()
        lttng('start', self._name)
        self._running = True

    def stop(self):
        """Returns when the tracepoints of all processes are off; what they have recorded may still be on its way."""
        lttng('stop', '--no-wait', self._name)
        if self._kernel_recorder:
            self._kernel_recorder.stop()
        self._running = False

    def finish(self):
        """Returns when all that was recorded has been written."""
        if not self._running:
            lttng('start', self._name)  # a session that is stopped already cannot be waited for
        lttng('stop', self._name)
        self._running = False

    def lost_events(self):
        """How many events the session has lost."""
        listing = ElementTree.fromstring(lttng('--mi', 'xml', 'list', self._name))
        counts = [int(element.text) for element in listing.iter() if element.tag.endswith('discarded_events')]
        return sum(count & (2 ** 63 - 1) for count in counts)  # bit 63 is set by mistake sometimes

    def recorded_bytes(self):
        """The size of the trace so far, of one that is written to the disk."""
        return sum(path.stat().st_size for path in self.directory.rglob('*') if path.is_file())

    def close(self):
        """Destroys the session and removes its trace."""
        if self._kernel_recorder:
            self._kernel_recorder.close()
            self._kernel_recorder = None
        subprocess.run(('lttng', 'destroy', '--no-wait', self._name), capture_output=True)
        shutil.rmtree(self.directory, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
