# SPDX-License-Identifier: Apache-2.0
"""How much is measured. The combinations are always those of the paper."""

from dataclasses import dataclass

SIZES = (1024, 32 * 1024, 64 * 1024, 256 * 1024)  # bytes, as in tests/benchmarks/latency/worker.hpp
RATES = (100, 500, 1000, 2000)  # messages a second
PROCESSES = (2, 1)


@dataclass(frozen=True)
class Preset:
    """
    The extent of the experiment.

    Every process is started anew for each generation. In a generation each combination has `blocks` blocks, a block is
    four batches: untraced, traced, traced, untraced.
    """

    name: str
    about: str
    generations: int
    blocks: int
    batch_seconds: float
    warm_up_messages: int  # before each batch that follows a switch; not counted
    sizes: tuple = SIZES
    rates: tuple = RATES
    processes: tuple = PROCESSES
    nodes: tuple = (10, 30)  # that discover each other
    repetitions: int = 5  # of what else is measured
    scale: float = 1.0    # of the durations of what else is measured

    def messages(self, rate):
        """The number of messages of a batch."""
        return max(2, round(self.batch_seconds * rate))


PRESETS = {preset.name: preset for preset in (
    Preset('quick', 'ten minutes', generations=5, blocks=1, batch_seconds=0.3, warm_up_messages=8),
    # 60 minutes of each combination with tracing and 60 without, as in the paper: ten generations of 36 blocks.
    Preset('full', '60 minutes of each combination, traced and untraced: 64 hours', generations=10, blocks=36,
           batch_seconds=5.0, warm_up_messages=100, nodes=(10, 30, 100), repetitions=21, scale=5.0),
    # For the tests of the machinery. Its figures mean nothing.
    Preset('tiny', 'a few seconds, figures without meaning', generations=2, blocks=1, batch_seconds=0.02,
           warm_up_messages=2, sizes=(1024,), rates=(2000,), processes=(2, 1), nodes=(2,), repetitions=2, scale=0.02),
)}
