# SPDX-License-Identifier: Apache-2.0
"""A distribution of latencies that keeps its memory small, however many messages there were."""

from collections import Counter

BIN_NS = 10  # the resolution of quantiles; mean, least and most are exact


class Distribution:
    """Latencies in nanoseconds. No message is left out."""

    def __init__(self, latencies=()):
        self._bins = Counter()
        self._sorted = None
        self.count = 0
        self.total = 0
        self.least = None
        self.most = None
        self.add(latencies)

    def add(self, latencies):
        """Adds a sequence of latencies."""
        if not len(latencies):
            return
        self._sorted = None
        self._bins.update(latency // BIN_NS for latency in latencies)
        self.count += len(latencies)
        self.total += sum(latencies)
        least, most = min(latencies), max(latencies)
        self.least = least if self.least is None else min(self.least, least)
        self.most = most if self.most is None else max(self.most, most)

    def add_shifted(self, other, shift_ns):
        """Adds the latencies of another distribution, each made `shift_ns` longer."""
        if other.count == 0:
            return
        self._sorted = None
        for position, count in other._bins.items():
            self._bins[position + round(shift_ns / BIN_NS)] += count
        self.count += other.count
        self.total += other.total + shift_ns * other.count
        least, most = other.least + shift_ns, other.most + shift_ns
        self.least = least if self.least is None else min(self.least, least)
        self.most = most if self.most is None else max(self.most, most)

    @property
    def mean(self):
        return self.total / self.count

    def quantile(self, part):
        """The latency that this part of the messages does not exceed."""
        if self._sorted is None:
            self._sorted = sorted(self._bins.items())
        rank = part * (self.count - 1)
        passed = 0
        for position, count in self._sorted:
            passed += count
            if passed > rank:
                return min(max((position + 0.5) * BIN_NS, self.least), self.most)
        return self.most

    def outliers(self):
        """
        What lies far out: above the third quartile by more than three times the distance of the quartiles.

        Returns their number, and the mean of all other messages. They stay in every other figure.
        """
        first, third = self.quantile(0.25), self.quantile(0.75)
        fence = third + 3 * (third - first)
        far = [(position, count) for position, count in self._bins.items() if position * BIN_NS > fence]
        number = sum(count for _, count in far)
        rest = self.count - number
        far_total = sum((position + 0.5) * BIN_NS * count for position, count in far)
        return number, (self.total - far_total) / rest if rest else self.mean

    def summary(self):
        """The distribution as it stands in the result, in microseconds."""
        number, mean_of_the_rest = self.outliers()
        us = {name: round(self.quantile(part) / 1e3, 3)
              for name, part in (('p1', 0.01), ('p5', 0.05), ('p25', 0.25), ('p50', 0.5), ('p75', 0.75),
                                 ('p95', 0.95), ('p99', 0.99))}
        return {'messages': self.count, 'mean': round(self.mean / 1e3, 3), **us, 'least': round(self.least / 1e3, 3),
                'most': round(self.most / 1e3, 3), 'outliers': number,
                'mean_without_outliers': round(mean_of_the_rest / 1e3, 3)}
