// SPDX-License-Identifier: Apache-2.0
// Numbers about many numbers.

// The nearest rank: the smallest value that at least this share of all values does not exceed.
function percentile(sorted, share) {
  return sorted.length === 0 ? NaN : sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)];
}

// `values` is a Float64Array.
function summary(values) {
  const sorted = values.slice().sort();
  let sum = 0;
  for (const value of sorted) sum += value;
  const mean = sum / sorted.length;
  let squares = 0;
  for (const value of sorted) squares += (value - mean) ** 2;
  return {
    count: sorted.length, sum, mean, sorted,
    stddev: sorted.length > 1 ? Math.sqrt(squares / (sorted.length - 1)) : 0,
    min: sorted.length ? sorted[0] : NaN, max: sorted.length ? sorted[sorted.length - 1] : NaN,
    p50: percentile(sorted, 0.5), p90: percentile(sorted, 0.9), p99: percentile(sorted, 0.99),
  };
}

// Whether values differ so much that only a logarithmic scale shows them all.
function isWide(sorted) {
  return sorted.length > 0 && sorted[0] > 0 && sorted[sorted.length - 1] > 30 * sorted[0];
}

// Counts in bins between the smallest and the largest value: of equal width, or of equal ratio if the values are wide.
function histogram(sorted, bins = 60) {
  if (sorted.length === 0) return {centers: [], counts: []};
  const [scale, back] = isWide(sorted) ? [Math.log, Math.exp] : [value => value, value => value];
  const low = scale(sorted[0]);
  const width = (scale(sorted[sorted.length - 1]) - low) / bins || 1;
  const counts = new Array(bins).fill(0);
  for (const value of sorted) ++counts[Math.min(bins - 1, Math.floor((scale(value) - low) / width))];
  return {centers: counts.map((_, i) => back(low + (i + 0.5) * width)), counts};
}

// Points of the cumulative distribution, at most `points` of them, dense at the slow end.
function cumulative(sorted, points = 400) {
  const n = sorted.length;
  const ranks = new Set();
  for (let i = 0; i <= points; ++i) {
    ranks.add(Math.min(n - 1, Math.round(i / points * (n - 1))));
    ranks.add(Math.max(0, Math.round(n - 1 - (n - 1) * 10 ** (-4 * i / points))));
  }
  const order = [...ranks].sort((a, b) => a - b);
  return {values: order.map(rank => sorted[rank]), shares: order.map(rank => (rank + 1) / n)};
}

// The differences of neighbours.
function intervals(times) {
  const result = new Float64Array(Math.max(0, times.length - 1));
  for (let i = 0; i < result.length; ++i) result[i] = times[i + 1] - times[i];
  return result;
}

// The first index whose value is not less than `value`.
function lowerBound(sorted, value, low = 0, high = sorted.length) {
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}
