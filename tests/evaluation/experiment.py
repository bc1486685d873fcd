# SPDX-License-Identifier: Apache-2.0
"""
The experiment of the paper: the latency of messages of 16 combinations of size and rate, with and without tracing.

Where the paper ran an hour without tracing and later an hour with it, here the session is switched on and off within the
life of the same processes, so that other work on the machine and the place of the programs in memory affect both sides. A
block is four batches: untraced, traced, traced, untraced. A steady drift of the machine cancels out within a block.
"""

import random
from collections import defaultdict
from dataclasses import dataclass, field

from .bootstrap import hierarchical, median, middle_mean
from .distribution import Distribution
from .presets import SIZES
from .session import Session, SessionError
from .worker import Exchange

SEED = 1


@dataclass(frozen=True)
class Combination:
    """Messages of a size at a rate, from one process to another or within one."""

    processes: int
    size: int  # bytes
    rate: int  # messages a second

    @property
    def name(self):
        return f"{self.size // 1024} KiB, {self.rate} Hz, {'two processes' if self.processes == 2 else 'one process'}"


@dataclass(frozen=True)
class Block:
    """An untraced and a traced batch that were measured next to each other. Times in microseconds."""

    untraced_total: float
    untraced_count: int
    traced_total: float
    traced_count: int
    median_difference: float
    untraced_median: float


def block_of(untraced, traced):
    """A block of two batches of latencies in nanoseconds."""
    return Block(sum(untraced) / 1e3, len(untraced), sum(traced) / 1e3, len(traced),
                 (median(traced) - median(untraced)) / 1e3, median(untraced) / 1e3)


@dataclass
class Samples:
    """What a combination has measured."""

    untraced: Distribution = field(default_factory=Distribution)
    traced: Distribution = field(default_factory=Distribution)
    generations: list = field(default_factory=list)  # each a list of blocks
    expected: int = 0  # messages
    memory_kib: list = field(default_factory=list)

    def add(self, untraced, traced, expected):
        self.untraced.add(untraced)
        self.traced.add(traced)
        self.generations[-1].append(block_of(untraced, traced))
        self.expected += expected


def mean_overhead(blocks):
    return (sum(block.traced_total for block in blocks) / sum(block.traced_count for block in blocks)
            - sum(block.untraced_total for block in blocks) / sum(block.untraced_count for block in blocks))


def median_overhead(blocks):
    return middle_mean([block.median_difference for block in blocks])


def untraced_median(strata):
    return middle_mean([block.untraced_median for block in strata[0]])


def combinations_of(preset, processes):
    return [Combination(processes, size, rate) for size in preset.sizes for rate in preset.rates]


class Experiment:
    """Runs the experiment with a program; `run` returns the samples of each combination."""

    def __init__(self, program, preset, plan, tuning, place, say=lambda text: None):
        self._program = program
        self._preset = preset
        self._plan = plan
        self._tuning = tuning
        self._place = place
        self._say = say
        self.lost_events = 0
        self.trace_bytes = 0
        self.samples = defaultdict(Samples)

    def run(self):
        for generation in range(self._preset.generations):
            for processes in self._preset.processes:
                self._say(f"generation {generation + 1} of {self._preset.generations}, "
                          f"{'two processes' if processes == 2 else 'one process'}")
                self._run_generation(generation, processes)
        if self.trace_bytes == 0:
            raise SessionError('the session has recorded nothing: is the tracepoint provider built?')
        return dict(self.samples)

    def _run_generation(self, generation, processes):
        combinations = combinations_of(self._preset, processes)
        chance = random.Random(f'{SEED} {generation} {processes}')
        with Exchange(self._program, processes, self._tuning) as exchange, \
                Session(self._plan, self._place.directory) as session:
            for combination in combinations:
                self.samples[combination].generations.append([])
                exchange.run(self._size_index(combination), self._preset.warm_up_messages, combination.rate)
            for _ in range(self._preset.blocks):
                chance.shuffle(combinations)  # no combination is always measured after the same one
                for combination in combinations:
                    self._run_block(combination, exchange, session)
            for combination in combinations:
                self.samples[combination].memory_kib.append(exchange.memory_kib())
            self.lost_events += session.lost_events()
            session.finish()
            self.trace_bytes += session.recorded_bytes()

    @staticmethod
    def _size_index(combination):
        return SIZES.index(combination.size)

    def _run_block(self, combination, exchange, session):
        messages = self._preset.messages(combination.rate)
        size = self._size_index(combination)

        def batch():
            exchange.run(size, self._preset.warm_up_messages, combination.rate)
            return exchange.run(size, messages, combination.rate)

        before = batch()
        session.start()
        traced = batch()
        traced_again = exchange.run(size, messages, combination.rate)
        session.stop()
        after = batch()
        self.samples[combination].add(before, traced, messages)
        self.samples[combination].add(after, traced_again, messages)


def overhead_json(groups, statistic, floor):
    """An overhead in microseconds and as a part of the untraced latency, each with its interval."""
    estimate = hierarchical(groups, lambda strata: statistic(strata[0]), SEED)
    return {'us': estimate.as_json(), 'part': estimate.scaled(1 / floor).as_json()}


def combination_json(combination, samples):
    """What stands in the result for a combination."""
    groups = [[blocks] for blocks in samples.generations]
    untraced, traced = samples.untraced.summary(), samples.traced.summary()
    return {
        'processes': combination.processes, 'bytes': combination.size, 'rate': combination.rate,
        'untraced': untraced, 'traced': traced,
        'untraced_median': hierarchical(groups, untraced_median, SEED).as_json(),
        'overhead_of_mean': overhead_json(groups, mean_overhead, untraced['mean']),
        'overhead_of_median': overhead_json(groups, median_overhead, untraced['p50']),
        'missed': 2 * samples.expected - untraced['messages'] - traced['messages'],
    }


def aggregate_json(samples):
    """
    All combinations together.

    As in the paper, the mean of the untraced messages of its combination is subtracted from each latency, and all are
    merged: combinations with a high rate have more messages. Beside it stands the mean in which each combination counts
    the same, and that of the medians, on which outliers have no effect.
    """
    untraced, traced = Distribution(), Distribution()
    for one in samples.values():
        untraced.add_shifted(one.untraced, -one.untraced.mean)
        traced.add_shifted(one.traced, -one.untraced.mean)
    generations = range(len(next(iter(samples.values())).generations))
    groups = [[one.generations[generation] for one in samples.values()] for generation in generations]

    def merged(strata):
        counts = [sum(block.traced_count for block in blocks) for blocks in strata]
        overheads = [mean_overhead(blocks) for blocks in strata]
        return sum(count * overhead for count, overhead in zip(counts, overheads)) / sum(counts)

    def mean_of(statistic):
        return lambda strata: sum(statistic(blocks) for blocks in strata) / len(strata)

    return {
        'untraced': untraced.summary(), 'traced': traced.summary(),
        'overhead_merged': hierarchical(groups, merged, SEED).as_json(),
        'overhead_of_means': hierarchical(groups, mean_of(mean_overhead), SEED).as_json(),
        'overhead_of_medians': hierarchical(groups, mean_of(median_overhead), SEED).as_json(),
    }


def result_json(experiment, plan, preset):
    """The whole experiment as it stands in the result."""
    ordered = sorted(experiment.samples.items(), key=lambda item: (-item[0].processes, item[0].size, item[0].rate))
    aggregates = {}
    for processes in preset.processes:
        aggregates[str(processes)] = aggregate_json(
            {combination: samples for combination, samples in ordered if combination.processes == processes})
    return {
        'session': {'name': plan.name, 'events': list(plan.events), 'contexts': list(plan.contexts),
                    'buffers': plan.buffers, 'subbuffer_size': plan.subbuffer_size, 'subbuffers': plan.subbuffers,
                    'read_timer_us': plan.read_timer_us},
        'generations': preset.generations, 'blocks': preset.blocks, 'batch_seconds': preset.batch_seconds,
        'seed': SEED, 'lost_events': experiment.lost_events, 'trace_bytes': experiment.trace_bytes,
        'combinations': [combination_json(combination, samples) for combination, samples in ordered],
        'aggregates': aggregates,
    }
