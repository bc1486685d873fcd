// SPDX-License-Identifier: Apache-2.0
// The states of lifecycle nodes as bars.

const kStateColors = {unconfigured: 220, inactive: 45, active: 145, finalized: 0, configuring: 265, activating: 95, deactivating: 30, cleaningup: 285, shuttingdown: 15, errorprocessing: 350};

function lifecycleView(data) {
  const intervalsOf = new Map();
  for (const interval of data.lifecycle) {
    if (selection.node !== null && interval.node !== selection.node) continue;
    if (!intervalsOf.has(interval.node)) intervalsOf.set(interval.node, []);
    intervalsOf.get(interval.node).push(interval);
  }
  if (intervalsOf.size === 0) return [panel('Lifecycle', element('p', {class: 'faint'}, 'The trace has no lifecycle nodes.'))];
  const whole = Math.max(1, data.duration);
  const bar = interval => element('div', {
    style: `left: ${100 * interval.begin / whole}%; width: ${100 * (interval.end - interval.begin) / whole}%; background: ${stateColor(interval.state)}`,
    title: `${interval.state}\n${formatDuration(interval.end - interval.begin)} from ${formatTime(interval.begin)}`}, interval.state);
  const bars = [...intervalsOf].flatMap(([node, list]) => [element('div', {}, nodeName(data, node)),
    element('div', {class: 'track', role: 'img', 'aria-label': list.map(i => `${i.state} from ${formatTime(i.begin)}`).join(', ')}, ...list.map(bar))]);
  return [
    panel('Lifecycle', element('div', {class: 'bars'}, ...bars)),
    panel('States', dataTable([...intervalsOf.values()].flat(), [
      {title: 'Node', value: row => nodeName(data, row.node)}, {title: 'State', value: row => row.state},
      {title: 'From', value: row => row.begin, show: row => formatTime(row.begin)},
      {title: 'For', value: row => row.end - row.begin, show: row => formatDuration(row.end - row.begin)},
    ], {name: 'state', sort: 2})),
    stateMemory(data),
  ];
}

// How much memory was asked for in each state, if the trace has the events of LTTng's libc wrapper.
function stateMemory(data) {
  const rows = data.state_memory.filter(row => selection.node === null || row.node === data.nodes[selection.node].name);
  if (rows.length === 0) return null;
  const count = (title, value) => ({title, value, show: row => formatCount(value(row))});
  return panel('Memory by state', dataTable(rows, [
    {title: 'Node', value: row => row.node}, {title: 'State', value: row => row.state},
    {title: 'From', value: row => row.begin, show: row => formatTime(row.begin)},
    {title: 'For', value: row => row.duration, show: row => formatDuration(row.duration)},
    count('Mallocs in callbacks', row => row.allocations), {title: 'Of them', value: row => row.bytes, show: row => formatSize(row.bytes)},
    count('Mallocs in the process', row => row.process_allocations), {title: 'Of it', value: row => row.process_bytes, show: row => formatSize(row.process_bytes)},
  ], {name: 'state', sort: 4, descending: true}), element('p', {class: 'note'},
    'Calls of malloc, calloc, realloc and the like. Other nodes may be part of the process. A node that is active should ask for none.'));
}

function stateColor(state) {
  return `hsl(${kStateColors[state] ?? 200} 50% ${color('bar-lightness')})`;
}
