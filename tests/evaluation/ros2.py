# SPDX-License-Identifier: Apache-2.0
"""
Builds the measured programs against another installation of ROS 2, from the same sources.

The installation is a prefix such as /opt/ros/jazzy, or one of `./dev install`.
"""

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

PACKAGE = Path(__file__).with_name('ros2_package')
BENCHMARKS = Path(__file__).parent.parent / 'benchmarks'
LATENCY = BENCHMARKS / 'latency'
# From a folder of BENCHMARKS, to src/ of the package.
SOURCES = ('latency/stack_worker.hpp', 'latency/worker.hpp', 'latency/worker.cpp', 'latency/stack_worker.cpp',
           'latency/stack_calls_worker.cpp', 'latency/stack_local_worker.cpp', 'latency/stack_discovery_worker.cpp',
           'idle_entities/bench_idle_entities.cpp', 'samples/samples_file.cpp')
# To include/ of the package, where they are found by their path in the repository.
HEADERS = ('samples/samples_file.hpp',)


class Ros2Error(Exception):
    """The prefix holds no ROS 2, or the programs do not build against it."""


@dataclass(frozen=True)
class OtherRos2:
    """The programs that were built against an installation, and the variables that they need."""

    prefix: Path
    tree: Path
    environment: dict

    @property
    def name(self):
        return f'rclcpp of {self.prefix}'

    def program(self, name):
        return str(self.tree / name)


def environment_of(prefix):
    """What programs of the installation need, beyond what is set already."""
    if not (prefix / 'share/rclcpp').is_dir():
        raise Ros2Error(f"{prefix}: no ROS 2 there: 'share/rclcpp' is missing")
    setup = prefix / 'setup.bash'
    if setup.exists():
        printed = subprocess.run(['bash', '-c', f'source "{setup}" >/dev/null && env -0'], capture_output=True, text=True)
        if printed.returncode != 0:
            raise Ros2Error(f'{setup} failed: {printed.stderr.strip()}')
        variables = dict(line.split('=', 1) for line in printed.stdout.split('\0') if '=' in line)
        changed = {name: value for name, value in variables.items() if os.environ.get(name) != value}
        for name in ('_', 'SHLVL', 'PWD', 'OLDPWD'):
            changed.pop(name, None)
    else:
        python = sorted(prefix.glob('lib/python3*/*-packages'))
        changed = {'AMENT_PREFIX_PATH': str(prefix), 'LD_LIBRARY_PATH': str(prefix / 'lib')}
        if python:
            changed['PYTHONPATH'] = ':'.join([str(python[-1]), os.environ.get('PYTHONPATH', '')])
    # Both sides on the same middleware.
    return {**changed, 'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp'}


def build(prefix, directory):
    """Builds the programs in a directory."""
    environment = environment_of(prefix.resolve())
    source, tree = directory / 'source', directory / 'build'
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(PACKAGE, source)
    for folder in ('msg', 'srv', 'action'):
        shutil.copytree(LATENCY / 'latency_msgs' / folder, source / folder)
    (source / 'src').mkdir()
    for name in SOURCES:
        shutil.copy2(BENCHMARKS / name, source / 'src')
    for name in HEADERS:
        place = source / 'include/tests/benchmarks' / name
        place.parent.mkdir(parents=True)
        shutil.copy2(BENCHMARKS / name, place)
    for command in (('cmake', '-S', source, '-B', tree, '-DCMAKE_BUILD_TYPE=Release',
                     f'-DCMAKE_PREFIX_PATH={prefix.resolve()}'),
                    ('cmake', '--build', tree, '-j', str(os.cpu_count()))):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                              env={**os.environ, **environment})
        if done.returncode != 0:
            log = directory / 'build.log'
            log.write_text(done.stdout + done.stderr)
            raise Ros2Error(f'the programs do not build against {prefix}; {log} says why')
    # The library of their messages lies beside them.
    libraries = ':'.join(filter(None, [str(tree), environment.get('LD_LIBRARY_PATH')]))
    return OtherRos2(prefix, tree, {**environment, 'LD_LIBRARY_PATH': libraries})
