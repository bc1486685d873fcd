# SPDX-License-Identifier: Apache-2.0
"""
Launches over several machines, which are hosts in namespaces of this one: they share its processors, so a figure tells what the
launcher and the agents cost, and nothing of a network. Each figure stands beside a floor, measured in turns with it.

Connecting commands are nsenter, which cost a few milliseconds; for the time until a dead connection is noticed it is a
relay that is stopped.
"""

import argparse
import json
import os
import re
import signal
import statistics
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from machine_hosts import Host
from own_launches import LAUNCH, PATIENCE, Lines

STAMP = os.environ['STAMP_PROGRAM']  # writes the time at which it runs to a pipe, and waits for a signal
HERE = 'this machine'


def milliseconds(nanoseconds):
    return nanoseconds / 1e6


class Bench:
    def __init__(self, folder, options):
        self.folder = folder
        self.options = options
        self.pipe = folder / 'stamps'
        os.mkfifo(self.pipe)
        self.stamps = os.open(self.pipe, os.O_RDWR)
        (folder / 'run').mkdir(mode=0o700)
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(('ROS_', 'LAUNCH_ON', 'AMENT_'))}
        self.environment.update(XDG_RUNTIME_DIR=str(folder / 'run'), HOME=str(folder), ROS_HOME=str(folder))
        self.hosts = []

    def make_hosts(self):
        for number in range(self.options.hosts):
            self.hosts.append(Host(f'host{number}', self.folder))

    def end_hosts(self):
        for host in self.hosts:
            host.end()

    # Launch files.

    def file(self, name, *lines):
        path = self.folder / name
        path.write_text('<launch>\n' + '\n'.join(lines) + '\n</launch>\n')
        return path

    def machine(self, host, connect=None, keepalive=5):
        return f'<machine name="{host.name}" connect="{connect or host.enter()}" keepalive="{keepalive}"/>'

    def stamping(self, count, hosts):
        """So many processes, spread over the hosts in turns; on this machine if there are none."""
        lines = [*map(self.machine, hosts), f'<set_env name="STAMP_PIPE" value="{self.pipe}"/>']
        lines += [f'<executable cmd="{STAMP}"' + (f' machine="{hosts[number % len(hosts)].name}"' if hosts else '') + '/>'
                  for number in range(count)]
        return self.file(f'{count}_on_{len(hosts)}.launch.xml', *lines)

    # Launches.

    def start(self, file, output=subprocess.DEVNULL):
        return subprocess.Popen([LAUNCH, str(file)], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=output,
                                stderr=subprocess.STDOUT, text=True, process_group=0)

    def last_stamp(self, count):
        """When the last of so many processes began to run, in nanoseconds."""
        data = b''
        while len(data) < 8 * count:
            data += os.read(self.stamps, 8 * count - len(data))
        return max(struct.unpack(f'={count}q', data))

    @staticmethod
    def stop(process):
        begin = time.monotonic_ns()
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE)
        return milliseconds(time.monotonic_ns() - begin)

    def time_of(self, *words):
        begin = time.monotonic_ns()
        subprocess.run(words, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True,
                       timeout=PATIENCE)
        return milliseconds(time.monotonic_ns() - begin)

    # Figures.

    def measure_first_process(self):
        """The time to one process there, against a launch of one here, and the connecting command that starts one without launch."""
        there = self.stamping(1, self.hosts[:1])
        here = self.stamping(1, [])
        values, of_here, of_command = [], [], []
        for _ in range(self.options.runs):
            for file, times in ((there, values), (here, of_here)):
                begin = time.monotonic_ns()
                launch = self.start(file)
                times.append(milliseconds(self.last_stamp(1) - begin))
                self.stop(launch)
            begin = time.monotonic_ns()
            command = subprocess.Popen([*self.hosts[0].enter().split(), f'STAMP_PIPE={self.pipe}', STAMP], stdin=subprocess.DEVNULL,
                                       process_group=0)
            of_command.append(milliseconds(self.last_stamp(1) - begin))
            os.killpg(command.pid, signal.SIGKILL)
            command.wait()
            self.hosts[0].run('pkill', '-KILL', '-x', Path(STAMP).name[:15])
        report('first process on another machine', 'ms', values, 'a launch of one here, and the bare connecting command',
               [a + b for a, b in zip(of_here, of_command)])
        print(f'  of it: a launch here {statistics.median(of_here):.1f} ms, the connecting command {statistics.median(of_command):.1f} ms; '
              f'the connection costs {statistics.median(values) - statistics.median(of_here) - statistics.median(of_command):.1f} ms more')

    def measure_many(self):
        count = self.options.processes
        files = {len(self.hosts): self.stamping(count, self.hosts), 0: self.stamping(count, [])}
        started = {name: [] for name in files}
        stopped = {name: [] for name in files}
        for _ in range(self.options.runs_of_many):
            for name, file in files.items():
                begin = time.monotonic_ns()
                launch = self.start(file)
                started[name].append(milliseconds(self.last_stamp(count) - begin))
                stopped[name].append(self.stop(launch))
        for what, times in (('started', started), ('stopped', stopped)):
            report(f'{count} processes on {len(self.hosts)} hosts {what}', 'ms', times[len(self.hosts)], 'the same on one machine', times[0])

    def measure_ps_and_memory(self):
        count = self.options.processes
        here = self.start(self.stamping(count, []))
        self.last_stamp(count)
        self.time_of(LAUNCH, 'ps')  # the first one reads the program from the disk
        floor = [self.time_of(LAUNCH, 'ps') for _ in range(self.options.runs)]
        of_launcher = [self.memory('launch')]
        self.stop(here)
        launch = self.start(self.stamping(count, self.hosts))
        self.last_stamp(count)
        values = [self.time_of(LAUNCH, 'ps') for _ in range(self.options.runs)]
        agents = self.memories('launch-agent')
        guardians = self.memories('launch-guardian', of_hosts=True)
        self.stop(launch)
        report(f'launch ps of {count} processes on {len(self.hosts)} hosts', 'ms', values, 'launch ps of as many here', floor)
        report(f'memory of one of {len(self.hosts)} agents with {count // len(self.hosts)} processes each (Pss)', 'MiB', agents, 'the launcher with all of them here',
               of_launcher)
        report('memory of the guardian of an agent (Pss)', 'MiB', guardians)

    def memory(self, name):
        return max(self.memories(name))

    def memories(self, name, of_hosts=False):
        """Of the processes of this benchmark that run the program, in MiB."""
        found = []
        of_host = {os.readlink(f'/proc/{host._first}/ns/pid') for host in self.hosts}
        for entry in Path('/proc').iterdir():
            try:
                if (entry.name.isdigit() and os.readlink(entry / 'exe').rsplit('/', 1)[-1] == name
                        and f'HOME={self.folder}'.encode() in (entry / 'environ').read_bytes()
                        and (not of_hosts or os.readlink(entry / 'ns/pid') in of_host)):
                    found.append(int(re.search(r'^Pss: +(\d+)', (entry / 'smaps_rollup').read_text(), re.M)[1]) / 1024)
            except OSError:
                continue
        return found

    def measure_lines(self):
        """What a process prints comes through the connection, gets its label, and is written to a file."""
        count = self.options.lines
        values, floor = [], []
        for _ in range(self.options.runs_of_many):
            for hosts, rates in ((self.hosts[:1], values), ([], floor)):
                seconds = [self.time_of_lines(lines, hosts) for lines in (1, count)]
                rates.append(count / (seconds[1] - seconds[0]))
        report(f'lines through a connection, {count} of 64 bytes', 'lines/s', values, 'the same from a process here', floor, higher=True)

    def time_of_lines(self, count, hosts):
        there = f' machine="{hosts[0].name}"' if hosts else ''
        text = 'x' * 63
        file = self.file('lines.launch.xml', *map(self.machine, hosts),
                         f'<executable{there} cmd="sh -c \'yes {text} | head -n {count}\'" output="screen"/>')
        with open(self.folder / 'lines', 'w+b') as output:
            begin = time.monotonic()
            code = self.start(file, output).wait(PATIENCE)
            seconds = time.monotonic() - begin
            output.seek(0)
            come = output.read().count(text.encode())
        if code != 0 or come != count:
            raise SystemExit(f'bench_machines: error: exit code {code}, {come} of {count} lines have come')
        return seconds

    def measure_dead_connection(self):
        """From the moment at which nothing comes through the connection any more until the launch says so."""
        host = self.hosts[0]
        values = []
        for _ in range(self.options.runs_of_dead):
            file = self.file('dead.launch.xml', self.machine(host, host.connect(), self.options.keepalive),
                             f'<set_env name="STAMP_PIPE" value="{self.pipe}"/><executable cmd="{STAMP}" machine="{host.name}"/>',
                             '<executable cmd="sleep 1000"/>')
            launch = self.start(file, subprocess.PIPE)
            lines = Lines(launch.stdout)
            self.last_stamp(1)
            (relay,) = [pid for pid in self.with_words('machine_door.py', 'enter', str(self.folder))]
            begin = time.monotonic_ns()
            os.kill(relay, signal.SIGSTOP)
            lines.wait_for(f"the connection to machine '{host.name}' is lost: ")
            values.append(milliseconds(time.monotonic_ns() - begin))
            try:
                os.kill(relay, signal.SIGCONT)
            except ProcessLookupError:
                pass  # the launch has ended it
            self.stop(launch)
        report('a dead connection is noticed', 'ms', values, f'keepalive="{self.options.keepalive}"',
               [self.options.keepalive * 1000] * len(values))

    @staticmethod
    def with_words(*words):
        """The processes that have all of these in their command line."""
        for entry in Path('/proc').iterdir():
            try:
                if entry.name.isdigit():
                    given = (entry / 'cmdline').read_bytes().decode(errors='replace')
                    if all(word in given for word in words):
                        yield int(entry.name)
            except OSError:
                continue


def report(name, unit, values, floor_name='', floor=(), higher=False):
    if not values:
        raise SystemExit(f'bench_machines: error: nothing was measured of: {name}')
    digits = 0 if unit == 'lines/s' else 1
    print(f'{name}\n  median {statistics.median(values):,.{digits}f} {unit} of {len(values)}, from {min(values):,.{digits}f} to '
          f'{max(values):,.{digits}f}')
    if floor:
        print(f'  {floor_name}: {statistics.median(floor):,.{digits}f} {unit}, ratio {statistics.median(values) / statistics.median(floor):.2f}')
    if path := os.environ.get('BENCHMARK_SAMPLES'):
        with open(path, 'a') as samples:
            samples.write(json.dumps({'name': name, 'unit': unit, 'values': list(values), 'floor_name': floor_name, 'floor': list(floor),
                                      'better': 'higher' if higher else 'lower'}) + '\n')


FIGURES = {'first': Bench.measure_first_process, 'many': Bench.measure_many, 'ps': Bench.measure_ps_and_memory, 'lines': Bench.measure_lines,
           'dead': Bench.measure_dead_connection}


def main():
    parser = argparse.ArgumentParser(prog='bench_machines', description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--hosts', type=int, default=10)
    parser.add_argument('--processes', type=int, default=100, help='spread over the hosts')
    parser.add_argument('--lines', type=int, default=1_000_000)
    parser.add_argument('--keepalive', type=float, default=2, help='seconds')
    parser.add_argument('--only', nargs='+', choices=FIGURES, default=list(FIGURES))
    parser.add_argument('--runs', type=int, default=11)
    parser.add_argument('--runs-of-many', type=int, default=5)
    parser.add_argument('--runs-of-dead', type=int, default=3)
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)
    # Not below /tmp, where each host has files of its own.
    with tempfile.TemporaryDirectory(prefix='bench-machines-', dir='/var/tmp') as folder:
        bench = Bench(Path(folder), options)
        try:
            bench.make_hosts()
            for figure in options.only:
                FIGURES[figure](bench)
        except unittest.SkipTest as reason:
            print(reason)
        finally:
            bench.end_hosts()


if __name__ == '__main__':
    main()
