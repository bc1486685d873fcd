# SPDX-License-Identifier: Apache-2.0
"""Runs a benchmark of tests/benchmarks and reads the samples that it reports (tests/benchmarks/samples)."""

import json
import os
import subprocess

from ..bootstrap import of_samples
from ..results import figure_of


class BenchmarkError(Exception):
    """A benchmark has failed; the message has its last line."""


def run(command, environment=None, timeout=1800):
    """Runs a program and returns what it prints."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=timeout,
                              env={**os.environ, **(environment or {})})
    except subprocess.TimeoutExpired:
        raise BenchmarkError(f'{os.path.basename(command[0])} is still running after {timeout} s') from None
    if done.returncode != 0:
        lines = (done.stderr.strip() or done.stdout.strip() or 'it says nothing').splitlines()
        raise BenchmarkError(f'{os.path.basename(command[0])} failed: {lines[-1]}')
    return done.stdout


def samples_of(bench, command, environment=None):
    """What a benchmark reports: a list of objects with name, unit, values, floor_name, floor, better."""
    file = bench.place.directory / 'samples'
    file.unlink(missing_ok=True)
    run(command, {**(environment or {}), 'BENCHMARK_SAMPLES': str(file)})
    if not file.exists():
        raise BenchmarkError(f'{os.path.basename(command[0])} has reported nothing')
    return [json.loads(line) for line in file.read_text().splitlines()]


def figure(group, samples, note=None):
    """The figure of one line of samples: their median, beside that of the floor."""
    floor = {}
    if samples['floor']:
        floor = {'floor': of_samples(samples['floor']), 'floor_name': samples['floor_name']}
    return figure_of(group, samples['name'], samples['unit'], of_samples(samples['values']), len(samples['values']),
                     better=samples['better'], note=note, **floor)
