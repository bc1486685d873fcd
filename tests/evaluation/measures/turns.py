# SPDX-License-Identifier: Apache-2.0
"""
Programs that exchange the same messages in turns, batch by batch, so that other work on the machine affects all of them.

Medians of batches, in generations of processes.
"""

import os
from dataclasses import dataclass, field
from typing import Callable

from ..bootstrap import hierarchical, median, middle_mean


@dataclass(frozen=True)
class Contestant:
    """A program by its name; `start` makes its exchange, with further variables of the environment."""

    name: str
    start: Callable
    environment: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Condition:
    """What is exchanged in a batch."""

    size_index: int
    rate: int  # messages a second


@dataclass
class Medians:
    """What the batches of a contestant have measured."""

    generations: list = field(default_factory=list)  # each a list of lists: medians (microseconds) by condition
    memory_mib: list = field(default_factory=list)   # one for each generation

    def estimate(self, condition):
        """Of the condition with this index."""
        return hierarchical([[group[condition]] for group in self.generations], lambda strata: middle_mean(strata[0]))

    @property
    def batches(self):
        return sum(len(group[0]) for group in self.generations)


def domain(number):
    """A DDS domain of its own for each of several programs that run at the same time."""
    return {'ROS_DOMAIN_ID': str(1 + (int(os.environ['ROS_DOMAIN_ID']) + number) % 100)}


def _generation(preset, contestants, conditions, batch_seconds, medians):
    exchanges = []
    try:
        for number, one in enumerate(contestants):
            exchanges.append((medians[one.name], one.start({**one.environment, **domain(number)})))
        for collected, _ in exchanges:
            collected.generations.append([[] for _ in conditions])
        for turn in range(2):
            for index, condition in enumerate(conditions):
                messages = max(2, round(batch_seconds * preset.scale * condition.rate))
                for collected, exchange in exchanges if turn == 0 else reversed(exchanges):
                    exchange.run(condition.size_index, preset.warm_up_messages, condition.rate)
                    latencies = exchange.run(condition.size_index, messages, condition.rate)
                    collected.generations[-1][index].append(median(latencies) / 1e3)
        for collected, exchange in exchanges:
            collected.memory_mib.append(exchange.memory_kib() / 1024)
    finally:
        for _, exchange in exchanges:
            exchange.close()


def measure(preset, contestants, conditions, batch_seconds):
    """Returns the medians of each contestant by its name."""
    medians = {one.name: Medians() for one in contestants}
    for _ in range(preset.repetitions):
        _generation(preset, contestants, conditions, batch_seconds, medians)
    return medians
