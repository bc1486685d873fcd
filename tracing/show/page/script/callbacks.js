// SPDX-License-Identifier: Apache-2.0
// The callbacks as a table, and of the chosen one its durations and intervals as plots.

function callbacksView(data) {
  const rows = data.callbacks.map((callback, id) => ({callback, ...callbackStatistics(data, id)}))
    .filter(row => row.count > 0 && isChosen(data, row.callback));
  const plots = element('div');
  const duration = (title, value) => ({title, value, show: row => formatDuration(value(row))});
  const table = dataTable(rows, [
    {title: 'Node', value: row => nodeName(data, row.callback.node) || processName(data, row.callback.process)},
    {title: 'Callback', value: row => row.callback.label, wide: true},
    {title: 'Count', value: row => row.count, show: row => formatCount(row.count)},
    {title: 'Rate', value: row => row.rate, show: row => formatRate(row.rate)},
    duration('Mean', row => row.durations.mean), duration('p50', row => row.durations.p50), duration('p99', row => row.durations.p99),
    duration('Max', row => row.durations.max), duration('Total', row => row.durations.sum),
    duration('Interval p50', row => row.gaps.p50), duration('Interval max', row => row.gaps.max), duration('Jitter', row => row.jitter),
    ...memoryColumns(data),
  ], {name: 'callback', sort: 8, descending: true, isActive: row => row.id === selection.callback,
    choose: row => select({callback: row.id === selection.callback ? null : row.id})});

  function showPlots() {
    const row = rows.find(candidate => candidate.id === selection.callback);
    plots.replaceChildren(row ? callbackPlots(data, row) : element('p', {class: 'note'}, 'Choose a callback to see its durations and intervals over time.'));
  }

  showPlots();
  const view = panel('Callbacks', table, element('p', {class: 'note'},
    'Interval: from one start to the next. Jitter, of a timer: how far the intervals are from its period, at p99.'));
  view.refresh = change => {
    if ('node' in change || 'topic' in change) return false;
    table.update();
    showPlots();
    return true;
  };
  return [view, plots];
}

// Of the whole trace, if it has the events of LTTng's libc wrapper.
function memoryColumns(data) {
  if (data.callback_memory.length === 0) return [];
  const of = new Map(data.callback_memory.map(([id, runs, calls, bytes]) => [id, {runs, calls, bytes}]));
  const value = (row, get) => of.has(row.id) && of.get(row.id).runs ? get(of.get(row.id)) : NaN;
  const column = (title, get, format) => ({title, value: row => value(row, get), show: row => Number.isNaN(value(row, get)) ? '–' : format(value(row, get))});
  return [column('Mallocs', memory => memory.calls, formatCount), column('for each run', memory => memory.calls / memory.runs, threeDigits),
    column('Memory', memory => memory.bytes, formatSize)];
}

function callbackPlots(data, row) {
  const {callback} = row;
  const level = callback.period > 0 ? {value: callback.period, name: 'period'} : null;
  const section = panel(callback.name,
    callback.symbol ? element('p', {class: 'note place'}, callback.symbol) : null,
    element('div', {class: 'plots'},
      timePlot('Duration over time', row.times, row.values, 'duration'),
      timePlot('Interval over time', row.starts.subarray(1), row.between, 'interval', level),
      distributionPlot('Distribution of durations', row.durations.sorted, 'duration'),
      distributionPlot('Distribution of intervals', row.gaps.sorted, 'interval'),
      cumulativePlot('Durations, cumulated', row.durations.sorted, 'duration'),
      cumulativePlot('Intervals, cumulated', row.gaps.sorted, 'interval')));
  const slowest = row.values.indexOf(row.durations.max);
  const list = data.instancesOf(row.id).filter(data.instances.finished);
  if (slowest >= 0) {
    section.append(element('p', {class: 'tools'}, element('button', {onclick: () => showInTime(data, list[slowest])},
      `Show the longest one (${formatDuration(row.durations.max)}) in the time chart`)));
  }
  return section;
}

// Opens the time chart at an instance. With the time at which something began that ends with it, all of that is shown,
// otherwise twenty times its duration around it.
function showInTime(data, instance, since = null) {
  const {start, end} = data.instances;
  const whole = end[instance] - (since ?? start[instance]);
  const span = Math.max(1e5, whole * (since === null ? 20 : 1.1));
  const from = Math.max(0, Math.min((since ?? start[instance]) - (since === null ? span / 3 : whole * 0.05), data.duration - span));
  timeChartOptions.view = {begin: from, end: Math.min(from + span, Math.max(1, data.duration)), top: 0};
  select({instance});
  showView('time');
}
