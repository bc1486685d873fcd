// SPDX-License-Identifier: Apache-2.0
// Plots, drawn by uPlot: values over time, distributions, cumulative distributions. Dragging zooms in, a double click
// shows everything again.

const kPlotHeight = 210;
const kMostPoints = 6000;

function axes(xValues, yValues) {
  const common = {stroke: color('faint'), grid: {stroke: color('line'), width: 1}, ticks: {stroke: color('line'), width: 1}, font: '11px system-ui, sans-serif'};
  return [{...common, values: xValues, space: 70}, {...common, values: yValues, size: 64}];
}

function makePlot(title, options, values) {
  const place = element('div', {class: 'plot'}, element('h3', {}, title));
  // uPlot needs the width, which is known when the element is in the page.
  const draw = () => {
    if (!place.isConnected) return;
    observer.disconnect();
    new uPlot({width: Math.max(240, place.clientWidth), height: kPlotHeight, cursor: {drag: {x: true, y: false}}, ...options}, values, place);
  };
  const observer = new ResizeObserver(draw);
  observer.observe(place);
  return place;
}

// Of many points, those that change the picture: the lowest and the highest of each of equal stretches of time.
function thinned(xs, ys) {
  if (xs.length <= kMostPoints) return [xs, ys];
  const [shownX, shownY] = [[], []];
  const stretches = kMostPoints / 2;
  for (let k = 0; k < stretches; ++k) {
    const begin = Math.floor(k * xs.length / stretches);
    const end = Math.floor((k + 1) * xs.length / stretches);
    let [low, high] = [begin, begin];
    for (let i = begin; i < end; ++i) {
      if (ys[i] < ys[low]) low = i;
      if (ys[i] > ys[high]) high = i;
    }
    for (const i of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
      shownX.push(xs[i]);
      shownY.push(ys[i]);
    }
  }
  return [shownX, shownY];
}

// Points (time, duration), both in nanoseconds. `level`: a line at a value that is expected, with its name.
function timePlot(title, times, values, name, level = null) {
  const [xs, ys] = thinned(times, values);
  const seconds = Array.from(xs, ns => ns / 1e9);
  const series = [
    {label: 'time', value: (_, v) => v === null ? '–' : formatTime(v * 1e9)},
    {label: name, stroke: color('accent'), width: 1, paths: () => null, points: {show: true, size: 4, fill: color('accent'), stroke: color('accent'), width: 0},
      value: (_, v) => v === null || v === undefined ? '–' : formatDuration(v)},
  ];
  const rows = [seconds, Array.from(ys)];
  if (level) {
    series.push({label: level.name, stroke: color('good'), width: 1.5, dash: [6, 4], points: {show: false}, value: () => formatDuration(level.value)});
    rows.push(new Array(seconds.length).fill(level.value));
  }
  return makePlot(title, {
    scales: {x: {time: false}, y: {range: (_, low, high) => low === null ? [0, 1] : [Math.min(0, low), high * 1.05 || 1]}}, series,
    axes: axes((_, ticks) => ticks.map(t => `${+t.toFixed(6)} s`), (_, ticks) => ticks.map(formatDuration)),
  }, rows);
}

function durationScale(sorted) {
  return isWide(sorted) ? {time: false, distr: 3} : {time: false};
}

// On a logarithmic scale uPlot labels only some ticks; the others are null.
function durationTicks(_, ticks) {
  return ticks.map(tick => tick === null ? null : formatDuration(tick));
}

function distributionPlot(title, sorted, name) {
  const {centers, counts} = histogram(sorted);
  return makePlot(title, {
    scales: {x: durationScale(sorted), y: {range: (_, low, high) => [0, high * 1.05 || 1]}},
    series: [
      {label: name, value: (_, v) => v === null ? '–' : formatDuration(v)},
      {label: 'count', stroke: color('accent'), fill: color('accent'), width: 0, paths: uPlot.paths.bars({size: [0.92], align: 0}), points: {show: false}},
    ],
    axes: axes(durationTicks, (_, ticks) => ticks.map(t => Number.isInteger(t) ? formatCount(t) : '')),
  }, [centers, counts]);
}

function cumulativePlot(title, sorted, name) {
  const {values, shares} = sorted.length ? cumulative(sorted) : {values: [], shares: []};
  return makePlot(title, {
    scales: {x: durationScale(sorted), y: {range: [0, 1]}},
    series: [
      {label: name, value: (_, v) => v === null ? '–' : formatDuration(v)},
      {label: 'share', stroke: color('accent'), width: 1.5, paths: uPlot.paths.stepped({align: 1}), points: {show: false}, value: (_, v) => v === null || v === undefined ? '–' : formatPercent(v)},
    ],
    axes: axes(durationTicks, (_, ticks) => ticks.map(t => `${Math.round(t * 100)} %`)),
  }, [values, shares]);
}

// The cumulative distributions of two runs in one plot.
function cumulativeOfBoth(title, [before, after]) {
  const least = Math.min(before[0], after[0]);
  // Each begins at 0, below the smallest of both. Of equal values the last share counts.
  const values = uPlot.join([before, after].map(sorted => {
    const {values: times, shares} = cumulative(sorted);
    const points = new Map([[least * 0.999, 0], [times[0] * 0.9999, 0], ...times.map((time, i) => [time, shares[i]])]);
    return [[...points.keys()], [...points.values()]];
  }));
  const line = (label, name) => ({label, stroke: color(name), width: 2, spanGaps: true, paths: uPlot.paths.stepped({align: 1}), points: {show: false},
    value: (_, v) => v === null || v === undefined ? '–' : formatPercent(v)});
  const isLogarithmic = least > 0 && Math.max(before.at(-1), after.at(-1)) > 30 * least;
  return makePlot(title, {
    scales: {x: isLogarithmic ? {time: false, distr: 3} : {time: false}, y: {range: [0, 1]}},
    series: [{label: 'time', value: (_, v) => v === null ? '–' : formatDuration(v)}, line('before', 'before'), line('after', 'after')],
    axes: axes(durationTicks, (_, ticks) => ticks.map(t => `${Math.round(t * 100)} %`)),
  }, values);
}
