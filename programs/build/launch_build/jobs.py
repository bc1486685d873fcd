# SPDX-License-Identifier: Apache-2.0
"""Builds packages side by side, each as soon as those that it needs are there."""

import asyncio
import configparser
import errno
import json
import os
import shutil
import signal
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO, Dict, List, Mapping, Optional, Sequence, Set

from .package_xml import Package
from .prefixes import build_environment
from .test_results import TestCounts, read_counts
from .workspace import all_needed, built_before, used


@dataclass
class Options:
    build: Path  # the folder that gets a build tree for each package
    install: Path
    underlays: List[Path]
    environment: Mapping[str, str]
    jobs: int = 1
    merge_install: bool = False
    cmake_arguments: List[str] = field(default_factory=list)
    tests: bool = True  # are built
    run_tests: bool = False
    go_on: bool = False  # with packages that do not need one that has failed
    ccache: bool = False  # if it is installed and nothing names another launcher of compilers


@dataclass
class Result:
    package: Package
    seconds: float
    failed_step: str = ''  # '' if it is built
    log: Optional[Path] = None  # of the failed step
    tests: Optional[TestCounts] = None  # if its tests ran


class Observer:
    def started(self, package: Package) -> None: ...
    def ended(self, result: Result) -> None: ...
    def refresh(self) -> None: ...  # several times a second


class Builder:
    def __init__(self, packages: Sequence[Package], workspace: Mapping[str, Package], options: Options, observer: Observer):
        self._packages, self._workspace, self._options, self._observer = packages, workspace, options, observer
        self._processes: Set[asyncio.subprocess.Process] = set()
        self._ended_one = asyncio.Event()  # a process of this build
        self._running = 0
        self.interrupted = False
        self.logs: Dict[str, Path] = {}  # of the packages that are being built
        self.skipped: List[Package] = []

    def run(self) -> List[Result]:
        if sys.version_info < (3, 12) and hasattr(os, 'pidfd_open'):
            asyncio.set_child_watcher(asyncio.PidfdChildWatcher())  # without a thread for each process; later the default
        return asyncio.run(self._run())

    async def _run(self) -> List[Result]:
        loop = asyncio.get_running_loop()
        for number in (signal.SIGINT, signal.SIGTERM):
            loop.add_signal_handler(number, self._interrupt)
        waiting, results = list(self._packages), []
        before = built_before({package.name: package for package in waiting})
        ticks = asyncio.create_task(self._tick())
        built: Set[str] = set()
        tasks: Set['asyncio.Task[Result]'] = set()
        stop = False
        while tasks or waiting:
            while not stop and len(tasks) < self._options.jobs:
                ready = next((p for p in waiting if before[p.name] <= built), None)
                if not ready:
                    break
                waiting.remove(ready)
                self._observer.started(ready)
                tasks.add(asyncio.create_task(self._package(ready)))
            if not tasks:
                break
            done, tasks = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                result = task.result()
                results.append(result)
                if not result.failed_step or result.failed_step == 'test':
                    built.add(result.package.name)
                elif not self._options.go_on:
                    stop = True
                stop |= self.interrupted
                if not self.interrupted:
                    self._observer.ended(result)
        self.skipped = waiting
        ticks.cancel()
        return results

    async def _tick(self) -> None:
        while True:
            await asyncio.sleep(0.2)
            self._observer.refresh()

    def _interrupt(self) -> None:
        self.interrupted = True
        for process in self._processes:
            try:
                os.killpg(process.pid, signal.SIGTERM)
            except ProcessLookupError:
                pass

    def prefix(self, package: Package) -> Path:
        return self._options.install if self._options.merge_install else self._options.install / package.name

    async def _package(self, package: Package) -> Result:
        begin = time.monotonic()
        self._running += 1
        tree = self._options.build / package.name
        tree.mkdir(parents=True, exist_ok=True)
        before = sorted(used(package, self._workspace))
        prefixes = [self.prefix(self._workspace[name]) for name in before]
        prefixes = list(dict.fromkeys(prefix for prefix in prefixes if prefix.is_dir()))
        environment = build_environment(self._options.environment, prefixes + self._options.underlays)
        result = Result(package, 0)
        for step, command, folder in self._steps(package, tree):
            log = tree / f'launch_build_{step}.log'
            self.logs[package.name] = log
            if step == 'test':
                # Its tests find the package itself, too, which has been installed by now.
                environment = build_environment(environment, [self.prefix(package)])
                _test_results(package, tree).unlink(missing_ok=True)
            code = await self._command(command, folder, environment, log)
            if step == 'test':
                result.tests = read_counts(_test_results(package, tree))
            if code != 0:
                result.failed_step, result.log = step, log
                break
            if step == 'configure':
                (tree / 'launch_build_arguments.json').write_text(json.dumps(command))
        self.logs.pop(package.name, None)
        self._running -= 1
        result.seconds = time.monotonic() - begin
        return result

    async def _command(self, command: List[str], folder: Path, environment: Mapping[str, str], log: Path) -> int:
        if self.interrupted:
            return 1
        with open(log, 'wb') as output:
            output.write(f'# {" ".join(command)}\n'.encode())
            output.flush()
            process = await self._start(command, folder, environment, output)
            if not process:
                return 1
            self._processes.add(process)
            try:
                return await process.wait()
            finally:
                self._processes.discard(process)
                self._ended_one.set()

    async def _start(self, command: List[str], folder: Path, environment: Mapping[str, str],
                     output: BinaryIO) -> Optional[asyncio.subprocess.Process]:
        """None if it cannot be started, which the output tells then. Where the system has no more processes or no memory for
        one, this waits for the end of another one of this build."""
        while True:
            try:
                return await asyncio.create_subprocess_exec(
                    *command, cwd=folder, env=dict(environment), stdin=asyncio.subprocess.DEVNULL, stdout=output,
                    stderr=asyncio.subprocess.STDOUT, start_new_session=True)
            except OSError as error:
                if error.errno not in (errno.EAGAIN, errno.ENOMEM) or not self._processes:
                    output.write(f'{command[0]}: error: cannot be started: {error.strerror}\n'.encode())
                    return None
            self._ended_one.clear()
            await self._ended_one.wait()
            if self.interrupted:
                return None

    def _steps(self, package: Package, tree: Path):  # type: ignore[no-untyped-def]
        """(name, command, folder) of each step. The number of processors is asked when a step begins."""
        options, prefix, source = self._options, self.prefix(package), package.folder
        if package.build_type == 'ament_python':
            yield from self._python_steps(package, tree)
            return
        configure = ['cmake', '-S', str(source), '-B', str(tree), f'-DCMAKE_INSTALL_PREFIX={prefix}']
        if shutil.which('ninja') and not (tree / 'Makefile').exists():
            configure += ['-G', 'Ninja']
        if not any(argument.startswith('-DCMAKE_BUILD_TYPE') for argument in options.cmake_arguments):
            configure.append('-DCMAKE_BUILD_TYPE=RelWithDebInfo')
        configure += self._compiler_launchers()
        configure += [f'-DBUILD_TESTING={"ON" if options.tests else "OFF"}', *options.cmake_arguments]
        siblings = sorted(all_needed(package, self._workspace))
        if siblings and not options.merge_install and package.build_type == 'ament_cmake':
            configure.append(f'-DAMENT_SIBLING_PREFIXES={";".join(siblings)}')
        known = tree / 'launch_build_arguments.json'
        if not (tree / 'CMakeCache.txt').exists() or not known.exists() or json.loads(known.read_text()) != configure:
            yield 'configure', configure, source
        processors = str(max(1, options.jobs // max(1, self._running)))
        yield 'build', ['cmake', '--build', str(tree), '-j', processors], source
        yield 'install', ['cmake', '--install', str(tree)], source
        if options.run_tests and options.tests:
            yield 'test', ['ctest', '--test-dir', str(tree), '--output-on-failure', '--output-junit',
                           str(_test_results(package, tree)), '-j', processors], source

    def _compiler_launchers(self) -> List[str]:
        options = self._options
        variables = [f'CMAKE_{language}_COMPILER_LAUNCHER' for language in ('C', 'CXX')]
        named = any(variable in options.environment for variable in variables) \
            or any('COMPILER_LAUNCHER' in argument for argument in options.cmake_arguments)
        if named or not options.ccache or not shutil.which('ccache', path=options.environment.get('PATH')):
            return []
        return [f'-D{variable}=ccache' for variable in variables]

    def _python_steps(self, package: Package, tree: Path):  # type: ignore[no-untyped-def]
        prefix = self.prefix(package)
        python = f'lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages'
        # Debian's Python would put data and programs below local. A package may name the folder of its programs in setup.cfg.
        install = ['--prefix', str(prefix), '--install-lib', str(prefix / python), '--install-data', str(prefix)]
        settings = configparser.ConfigParser(interpolation=None)
        settings.read(package.folder / 'setup.cfg', encoding='utf-8')
        if not any(settings.has_option('install', name) for name in ('install_scripts', 'install-scripts')):
            install += ['--install-scripts', str(prefix / 'bin')]
        yield 'install', [sys.executable, '-W', 'ignore', 'setup.py', '-q', 'egg_info', '--egg-base', str(tree),
                          'build', '--build-base', str(tree / 'build'), 'install', *install,
                          '--single-version-externally-managed', '--record', str(tree / 'installed_files')], package.folder
        if self._options.run_tests and (package.folder / 'test').is_dir():
            yield 'test', [sys.executable, '-m', 'pytest', 'test', '-p', 'no:cacheprovider',
                           f'--junit-xml={_test_results(package, tree)}'], package.folder


def _test_results(package: Package, tree: Path) -> Path:
    return tree / 'test_results' / ('pytest.xml' if package.build_type == 'ament_python' else 'ctest.xml')
