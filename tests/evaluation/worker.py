# SPDX-License-Identifier: Apache-2.0
"""
The measured programs: publishers and subscribers of tests/benchmarks/latency, driven through their stdin and stdout.

tests/benchmarks/latency/worker.hpp describes the exchange. The programs take the times; nothing here is timed.
"""

import os
import select
import struct
import subprocess
import time
from array import array

PATIENCE = 60.0  # seconds beyond what a batch takes


class WorkerError(Exception):
    """A program has ended, or is silent."""


class Worker:
    """A program on one processor; it is killed at the end of the scope."""

    def __init__(self, program, role, processor, tuning, environment=None):
        """Without tuning it runs where and as the kernel wants."""
        self.name = f'{os.path.basename(program)} {role}'.rstrip()
        self.started = time.monotonic_ns()
        self._process = subprocess.Popen(
            (program, *role.split()), stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
            env={**os.environ, **(environment or {})},
            preexec_fn=(lambda: tuning.prepare_child(processor)) if tuning else None)

    def send(self, data):
        try:
            self._process.stdin.write(data)
        except BrokenPipeError:
            raise WorkerError(f'{self.name} has ended') from None

    def receive(self, length, patience=PATIENCE):
        parts = []
        while length:
            if not select.select([self._process.stdout], [], [], patience)[0]:
                raise WorkerError(f'{self.name} is silent: no message, or its last one was lost')
            part = os.read(self._process.stdout.fileno(), length)
            if not part:
                raise WorkerError(f'{self.name} has ended')
            parts.append(part)
            length -= len(part)
        return b''.join(parts)

    def memory_kib(self):
        """The resident memory."""
        with open(f'/proc/{self._process.pid}/status') as status:
            return next(int(line.split()[1]) for line in status if line.startswith('VmRSS:'))

    def proportional_kib(self):
        """The memory of its own, and its part of what it shares with others."""
        with open(f'/proc/{self._process.pid}/smaps_rollup') as maps:
            return next(int(line.split()[1]) for line in maps if line.startswith('Pss:'))

    def expect_ready(self):
        if self.receive(1) != b'R':
            raise WorkerError(f'{self.name} says something else than that it is ready')

    def finish(self):
        """Ends the input, and waits until the program has ended on its own."""
        self._process.stdin.close()
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            raise WorkerError(f'{self.name} does not end') from None

    def close(self):
        self._process.kill()
        self._process.wait()
        self._process.stdin.close()
        self._process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Exchange:
    """A publisher and a subscriber, in two processes or in one."""

    subscriber_role = 'subscriber'

    def __init__(self, program, processes, tuning, environment=None):
        if processes == 1:
            self._publisher = self._subscriber = Worker(program, 'both', 0, tuning, environment)
        else:
            self._subscriber = Worker(program, self.subscriber_role, 1, tuning, environment)
            self._publisher = Worker(program, 'publisher', 0, tuning, environment)
        self._workers = {self._publisher, self._subscriber}
        for worker in self._workers:
            worker.expect_ready()

    def run(self, size_index, messages, rate):
        """Sends a batch; returns the latencies in nanoseconds. A late reader misses what the writer no longer keeps."""
        self._publisher.send(struct.pack('=QQq', size_index, messages, round(1e9 / rate)))
        count, = struct.unpack('=Q', self._subscriber.receive(8, PATIENCE + messages / rate))
        latencies = array('q')
        latencies.frombytes(self._subscriber.receive(8 * count))
        return latencies

    def memory_kib(self):
        """The resident memory of all processes."""
        return sum(worker.memory_kib() for worker in self._workers)

    def close(self):
        for worker in self._workers:
            worker.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Caller(Exchange):
    """A program that times what it does, and the one that answers it, if it needs one."""

    def __init__(self, program, role, server_role, tuning, environment=None):
        self._workers = set()
        if server_role:
            server = Worker(program, server_role, 1, tuning, environment)
            self._workers.add(server)
        self._publisher = self._subscriber = Worker(program, role, 0, tuning, environment)
        self._workers.add(self._publisher)
        for worker in self._workers:
            worker.expect_ready()
