// SPDX-License-Identifier: Apache-2.0
// Quantities as people read them. Times are nanoseconds.

// "999 ns", "1.23 µs", "45.6 ms", "107 s": three digits, as in the report on the terminal.
function formatDuration(ns) {
  if (ns === null || Number.isNaN(ns)) return '–';
  const size = Math.abs(ns);
  if (size < 999.5) return `${Math.round(ns)} ns`;
  for (const [unit, factor] of [['µs', 1e3], ['ms', 1e6], ['s', 1e9]]) {
    const value = ns / factor;
    if (Math.abs(value) < 999.5 || unit === 's') return `${threeDigits(value)} ${unit}`;
  }
}

function threeDigits(value) {
  const size = Math.abs(value);
  return value.toFixed(size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
}

// A time of the trace: seconds after its begin, with as many digits as `step` needs.
function formatTime(ns, step = 1000) {
  const digits = Math.max(0, Math.min(9, 9 - Math.floor(Math.log10(Math.max(step, 1)))));
  return `${(ns / 1e9).toFixed(digits)} s`;
}

// Of `count` things between the first one and the last one, in a second, as in the report on the terminal. A burst has
// none: the time between these is less than a tenth of that from the first one to the end of the trace.
function rateOf(count, first, last, end) {
  return count < 2 || last <= first || (last - first) * 10 < end - first ? NaN : (count - 1) * 1e9 / (last - first);
}

function formatRate(rate) {
  return Number.isNaN(rate) ? '–' : `${threeDigits(rate)} Hz`;
}

function formatCount(count) {
  return count.toLocaleString('en-US');
}

// "999 bytes", "1.2 kB", "34.5 MB", as in the report on the terminal.
function formatSize(bytes) {
  if (bytes < 1000) return `${bytes} byte${bytes === 1 ? '' : 's'}`;
  const [unit, factor] = bytes < 999950 ? ['kB', 1e3] : bytes < 999.95e6 ? ['MB', 1e6] : ['GB', 1e9];
  return `${(bytes / factor).toFixed(1)} ${unit}`;
}

function plural(count, noun) {
  return `${formatCount(count)} ${noun}${count === 1 ? '' : noun.endsWith('s') ? 'es' : 's'}`;
}

function formatPercent(share) {
  return `${threeDigits(share * 100)} %`;
}
