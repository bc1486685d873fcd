# SPDX-License-Identifier: Apache-2.0
"""
Where the cases run: a copy of their folder, directories of their own, and, as root, namespaces of their own. Each case has a
ROS domain of its own.
"""

import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

PATIENCE = 120.0  # seconds
OF_COMPILERS = 600.0  # beside others, on a machine that has just begun
INSIDE = 'CASES_INSIDE'
# A source of a test that is compiled with all of rclcpp: programs of the cases are compiled as it is.
MODEL = 'rclcpp_application_test'


class Wrong(Exception):
    """The product does not do what the case wants."""


class NotRun(Exception):
    """This machine lacks something that the case needs."""


def expect(condition, words):
    if not condition:
        raise Wrong(words)


def expect_in(part, text, what='the output'):
    if part not in text:
        raise Wrong(f'{what} lacks {part!r}: {text[-1500:]}')


def enter():
    """As root, starts this program again in namespaces, once: processes, network, session daemon and shared memory."""
    if os.geteuid() != 0 or os.environ.get(INSIDE) or shutil.which('unshare') is None:
        return
    os.environ[INSIDE] = '1'
    script = ('mount -t tmpfs -o mode=1777 tmpfs /run && mount -t tmpfs -o mode=1777 tmpfs /dev/shm && ip link set lo up && '
              'ip route add 224.0.0.0/4 dev lo && "$@"; exit $?')  # the shell stays, and reaps daemons
    os.execvp('unshare', ['unshare', '--mount', '--net', '--pid', '--fork', '--kill-child', '--mount-proc', '--propagation',
                          'private', 'bash', '-c', script, 'cases', sys.executable, '-B', *sys.argv])


class Running:
    """A program that runs beside; its output so far is `text`."""

    def __init__(self, place, words, environment):
        self.text = ''
        self._changed = threading.Condition()
        self._process = subprocess.Popen(words, cwd=place.folder, env=environment, text=True, errors='replace',
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            with self._changed:
                self.text += line
                self._changed.notify()
        with self._changed:
            self._changed.notify()

    def wait_for(self, *parts):
        """Waits until the output holds them all; Wrong if the program ends before, or does not come to it."""
        end = time.monotonic() + PATIENCE
        with self._changed:
            while any(part not in self.text for part in parts):
                if not self._reader.is_alive() or time.monotonic() > end:
                    raise Wrong(f'the output of a program lacks one of {parts}: {self.text[-1500:]}')
                self._changed.wait(0.2)
            return self.text

    def end(self, number=signal.SIGINT):
        """Asks the program to end, and waits. Returns the whole output."""
        if self._process.poll() is None:
            os.killpg(self._process.pid, number)
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            raise Wrong(f'a program does not end when it is asked to: {self.text[-1500:]}') from None
        finally:
            self._reader.join()
        return self.text


class Place:
    """What one case runs in. All programs that it has started end with it."""

    def __init__(self, house, name, domain):
        self._house = house
        self.folder = house.cases / name
        self.own = house.directory / f'case-{domain}'
        self.own.mkdir(parents=True)
        self.own.chmod(0o755)
        self.prefix = house.prefix
        self.environment = {key: value for key, value in os.environ.items() if not key.startswith(('ROS_', 'RMW_'))}
        self.environment.update(
            HOME=str(self.own), ROS_HOME=str(self.own / 'ros'), ROS_LOG_DIR=str(self.own / 'log'), TMPDIR=str(self.own),
            ROS_TRACE_DIR=str(self.own / 'traces'), LTTNG_HOME=str(house.directory), XDG_RUNTIME_DIR=str(self.own),
            ROS_DOMAIN_ID=str(domain), AMENT_PREFIX_PATH=f'{self.prefix}:{house.cases / "fakep"}',
            PATH=f'{self.prefix / "bin"}:{os.environ["PATH"]}', PYTHONDONTWRITEBYTECODE='1')
        self._running = []

    def end(self):
        for running in self._running:
            running.end(signal.SIGKILL)

    def run(self, *words, code=0, patience=PATIENCE, **environment):
        """Runs a command to its end; both of its outputs. `code` None: any exit code."""
        words = [str(word) for word in words]
        try:
            done = subprocess.run(words, cwd=self.folder, env={**self.environment, **environment}, text=True, errors='replace',
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=patience)
        except subprocess.TimeoutExpired as error:
            raise Wrong(f'{shlex.join(words)} does not end: {(error.stdout or b"")[-1500:]}') from None
        if code is not None and done.returncode != code:
            raise Wrong(f'{shlex.join(words)} has ended with {done.returncode}, not {code}: {done.stdout[-1500:]}')
        return done.stdout

    def launch(self, *words, code=0, **environment):
        return self.run(self.prefix / 'bin/launch', *words, code=code, **environment)

    def start(self, *words, **environment):
        running = Running(self, [str(word) for word in words], {**self.environment, **environment})
        self._running.append(running)
        return running

    def start_launch(self, *words):
        return self.start(self.prefix / 'bin/launch', *words)

    def node(self, package, program, *words):
        return self.start(self.prefix / 'lib' / package / program, *words)

    def until(self, look, holds, words):
        """Looks again until what it sees holds. Wrong if it never does."""
        end = time.monotonic() + PATIENCE
        while True:
            seen = look()
            if holds(seen):
                return seen
            expect(time.monotonic() < end, f'{words}: {seen[-1500:]}')

    def findings(self, *words):
        """What `launch check` finds: {(file, line): ids}."""
        found = {}
        for each in json.loads(self.launch('check', '--format', 'json', *words, code=None)):
            found.setdefault((Path(each['file']).name, each['line']), []).append(each['id'])
        return found

    def compile(self, source):
        """Compiles a program of the case as a test of rclcpp is compiled, and returns its path."""
        model = next((entry for entry in json.loads((self._house.build / 'compile_commands.json').read_text())
                      if f'{MODEL}.dir/' in entry['command']), None)
        if model is None:
            raise NotRun(f'the build has no {MODEL}')
        words = shlex.split(model['command'])
        options = [word for word in words[1:words.index('-o')] if not word.startswith(('-W', '-Winvalid-pch'))]
        program = self.own / Path(source).stem
        libraries = ('rclcpp', 'std_msgs', 'std_srvs', 'rcl_interfaces', 'rcl', 'rmw', 'rcutils')
        self.run(words[0], *options, '-w', self.folder / source, '-o', program, f'-L{self.prefix / "lib"}',
                 f'-Wl,-rpath,{self.prefix / "lib"},-rpath-link,{self.prefix / "lib"}', *(f'-l{name}' for name in libraries),
                 '-pthread', patience=OF_COMPILERS)
        return program


class House:
    """What all cases have in common."""

    def __init__(self, cases, build):
        self.build = Path(build).resolve()
        self.prefix = self.build / 'prefix'
        self.directory = Path(tempfile.mkdtemp(prefix='cases-'))
        self.directory.chmod(0o755)
        self.cases = self.directory / 'cases'
        shutil.copytree(cases, self.cases)

    def close(self):
        shutil.rmtree(self.directory, ignore_errors=True)
